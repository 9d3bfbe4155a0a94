// SPDX-License-Identifier: Apache-2.0
#include "dismantle/io/mesh_source.h"

namespace dismantle {

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string result = "\"";
  for (const char c : text.substr(0, kLongest)) result.push_back(c >= ' ' && c <= '~' ? c : '?');
  return result + (text.size() > kLongest ? "...\"" : "\"");
}

}  // namespace dismantle
