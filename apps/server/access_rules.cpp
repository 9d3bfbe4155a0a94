// SPDX-License-Identifier: Apache-2.0
#include "apps/server/access_rules.h"

#include <sys/random.h>

#include <algorithm>

namespace dismantle::server {

namespace {

constexpr std::string_view kScheme = "http://";
constexpr std::string_view kBearer = "Bearer ";
constexpr std::string_view kTokenPrefix = "token.";

// 'self' covers the socket; browsers refuse ws://[::1] as a source.
constexpr std::string_view kPolicy =
    "default-src 'self'; img-src 'self' data: blob:; connect-src 'self'; object-src 'none'; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'";

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

}  // namespace

std::string random_token() {
  unsigned char bits[16];
  std::size_t have = 0;
  while (have < sizeof bits) {
    const ssize_t count = getrandom(bits + have, sizeof bits - have, 0);
    if (count > 0) have += static_cast<std::size_t>(count);
  }
  std::string text;
  for (const unsigned char byte : bits) {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

bool equal_in_constant_time(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  volatile unsigned difference = 0;  // volatile: the loop has no short cut
  for (std::size_t i = 0; i < a.size(); ++i)
    difference = difference | (static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]));
  return difference == 0;
}

AccessRules::AccessRules(std::uint16_t port, std::string token) : port_(port), token_(std::move(token)) {
  const std::string suffix = ":" + std::to_string(port);
  hosts_ = {"127.0.0.1" + suffix, "localhost" + suffix, "[::1]" + suffix};
}

std::string_view AccessRules::content_security_policy() {
  return kPolicy;
}

bool AccessRules::is_own_host(std::string_view host) const {
  for (const std::string& own : hosts_)
    if (host == own) return true;
  return false;
}

bool AccessRules::is_own_origin(std::string_view origin) const {
  return origin.substr(0, kScheme.size()) == kScheme && is_own_host(origin.substr(kScheme.size()));
}

bool AccessRules::is_authorized(std::string_view authorization) const {
  if (authorization.substr(0, kBearer.size()) != kBearer) return false;
  return equal_in_constant_time(authorization.substr(kBearer.size()), token_);
}

bool AccessRules::offers_token(std::string_view subprotocols) const {
  bool protocol = false, token = false;
  while (!subprotocols.empty()) {
    const std::size_t comma = std::min(subprotocols.find(','), subprotocols.size());
    const std::string_view one = trimmed(subprotocols.substr(0, comma));
    subprotocols.remove_prefix(std::min(comma + 1, subprotocols.size()));
    protocol |= one == kProtocol;
    if (one.substr(0, kTokenPrefix.size()) == kTokenPrefix)
      token |= equal_in_constant_time(one.substr(kTokenPrefix.size()), token_);
  }
  return protocol && token;
}

}  // namespace dismantle::server
