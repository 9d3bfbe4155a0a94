// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/host_device.h"

#include <cstdint>

namespace dismantle {

/// A typed index: an Id of one kind does not convert to another kind. Invalid by default.
template <class Tag>
struct Id {
  static constexpr std::uint32_t kInvalid = 0xffffffffu;  ///< The value of an invalid Id.
  std::uint32_t value = kInvalid;                         ///< The index.

  constexpr Id() = default;
  /// The Id of an index.
  DISMANTLE_HOST_DEVICE explicit constexpr Id(std::uint32_t index) : value(index) {}
  /// False by default.
  DISMANTLE_HOST_DEVICE constexpr bool valid() const { return value != kInvalid; }
  friend constexpr bool operator==(Id, Id) = default;
  friend constexpr auto operator<=>(Id, Id) = default;
};

using ComponentId = Id<struct ComponentTag>;  ///< Index of a component within its Assembly.
using FaceId = Id<struct FaceTag>;            ///< Index of a triangle within its mesh or stream.
using VertexId = Id<struct VertexTag>;        ///< Index of a vertex within its mesh or stream.

}  // namespace dismantle
