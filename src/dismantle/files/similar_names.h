// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"

#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// The names that someone who typed `typed` may have meant, the likeliest first: those that contain it, those that are
/// a few letters off (a quarter of its length, at least one; two letters that are exchanged count as one), and those
/// whose beginning is. Upper and lower case of ASCII letters are the same. Bytes are compared, so that an accented
/// letter counts as two.
/// @param max_count largest number of names returned
std::vector<std::string> similar_names(std::string_view typed, Span<const std::string> names,
                                       std::size_t max_count = 3);

/// The end of a message about an unknown name: "; did you mean 'a', 'b' or 'c'?". Empty where no name is similar.
std::string did_you_mean(std::string_view typed, Span<const std::string> names);

}  // namespace dismantle
