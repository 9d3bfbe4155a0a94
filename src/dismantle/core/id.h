// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/host_device.h"

#include <cstdint>

namespace dismantle {

/// A typed index: an Id of one kind cannot be passed where another kind is wanted. Invalid by default.
template <class Tag>
struct Id {
  static constexpr std::uint32_t kInvalid = 0xffffffffu;
  std::uint32_t value = kInvalid;

  constexpr Id() = default;
  DISMANTLE_HOST_DEVICE explicit constexpr Id(std::uint32_t index) : value(index) {}
  DISMANTLE_HOST_DEVICE constexpr bool valid() const { return value != kInvalid; }
  friend constexpr bool operator==(Id, Id) = default;
  friend constexpr auto operator<=>(Id, Id) = default;
};

using ComponentId = Id<struct ComponentTag>;  ///< Index of a component within its Assembly.
using FaceId = Id<struct FaceTag>;            ///< Index of a triangle within its mesh or stream.
using VertexId = Id<struct VertexTag>;        ///< Index of a vertex within its mesh or stream.

}  // namespace dismantle
