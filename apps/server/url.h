// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace dismantle::server {

/// The target of a request line, decoded.
struct RequestTarget {
  std::string path;                          ///< "/api/open"
  std::map<std::string, std::string> query;  ///< "name" -> "vice.step"; of a repeat the first
};

/// Takes "/path?a=b&c=d" apart. None where it does not begin with a slash, an escape is broken, or it holds a zero
/// byte.
std::optional<RequestTarget> parse_target(std::string_view text);

}  // namespace dismantle::server
