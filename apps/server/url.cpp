// SPDX-License-Identifier: Apache-2.0
#include "apps/server/url.h"

#include <algorithm>

namespace dismantle::server {

namespace {

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::optional<std::string> decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '%') {
      if (i + 2 >= text.size()) return {};
      const int high = hex_value(text[i + 1]), low = hex_value(text[i + 2]);
      if (high < 0 || low < 0) return {};
      c = static_cast<char>(16 * high + low);
      i += 2;
    }
    if (c == '\0') return {};
    result += c;
  }
  return result;
}

}  // namespace

std::optional<RequestTarget> parse_target(std::string_view text) {
  if (text.empty() || text[0] != '/') return {};
  const std::size_t mark = std::min(text.find('?'), text.size());
  const std::optional<std::string> path = decoded(text.substr(0, mark));
  if (!path) return {};
  RequestTarget target{*path, {}};

  std::string_view query = text.substr(std::min(mark + 1, text.size()));
  while (!query.empty()) {
    const std::size_t end = std::min(query.find('&'), query.size());
    const std::string_view one = query.substr(0, end);
    query.remove_prefix(std::min(end + 1, query.size()));
    const std::size_t equals = std::min(one.find('='), one.size());
    const std::optional<std::string> name = decoded(one.substr(0, equals));
    const std::optional<std::string> value = decoded(one.substr(std::min(equals + 1, one.size())));
    if (!name || !value) return {};
    target.query.try_emplace(*name, *value);
  }
  return target;
}

}  // namespace dismantle::server
