// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// Sorts keys ascending on the calling thread, least significant digit first, skipping digits that all keys share: 4 to
/// 8 times as fast as std::sort from some thousand keys on.
/// @param scratch grown to the number of keys; reuse it to save the allocation
void radix_sort(Span<std::uint64_t> keys, std::vector<std::uint64_t>& scratch);

}  // namespace dismantle
