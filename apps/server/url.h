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
  std::map<std::string, std::string> query;  ///< "name" -> "vice.step"; the first value if repeated
};

/// Parses "/path?a=b&c=d". None if it does not begin with a slash, has a malformed escape sequence, or contains a zero
/// byte.
std::optional<RequestTarget> parse_target(std::string_view text);

}  // namespace dismantle::server
