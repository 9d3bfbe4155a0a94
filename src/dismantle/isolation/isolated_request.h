// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/isolation/isolated_process.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dismantle {

/// What the parent gives a child on its standard input.
struct IsolatedRequest {
  std::int64_t parent = 0;                      ///< Its process.
  IsolationLimits limits;                       ///< silence_seconds is for the parent.
  std::vector<std::filesystem::path> readable;  ///< See IsolatedProgram.
  std::string request;                          ///< See IsolatedProgram.
};

/// The descriptor on which the child writes to its parent.
inline constexpr int kLineDescriptor = 3;

/// The bytes of a request, and back; none if they are malformed.
std::string bytes_of(const IsolatedRequest& request);
/// See bytes_of().
std::optional<IsolatedRequest> request_from(std::string_view bytes);

}  // namespace dismantle
