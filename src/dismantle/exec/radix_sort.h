// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// Sorts keys ascending, on the calling thread: least significant digit first, digits that all keys share left out;
/// 4 to 8 times as fast as comparing from some thousand keys on. `scratch` is grown to the keys' number and can be kept
/// from call to call.
void radix_sort(Span<std::uint64_t> keys, std::vector<std::uint64_t>& scratch);

}  // namespace dismantle
