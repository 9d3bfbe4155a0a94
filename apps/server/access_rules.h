// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace dismantle::server {

/// 128 random bits from the kernel as 32 hexadecimal digits.
std::string random_token();

/// True if the two are equal; takes a time that depends only on their lengths.
bool equal_in_constant_time(std::string_view a, std::string_view b);

/// The access rules of the server (docs/wire.md, "Access"): a web page of another origin cannot send our Host, our
/// Origin and the token of this run.
class AccessRules {
 public:
  /// Rules for a server on `port` of the loopback addresses, whose clients must know `token`.
  AccessRules(std::uint16_t port, std::string token);

  /// The port that the server listens on.
  std::uint16_t port() const { return port_; }
  /// The token of this run.
  const std::string& token() const { return token_; }
  /// True if a request's Host is one of our own literals (else 421).
  bool is_own_host(std::string_view host) const;
  /// True if an Origin is one of our own literals (else 403); never compared with Host.
  bool is_own_origin(std::string_view origin) const;
  /// True if a header `Authorization: Bearer TOKEN` has our token (else 401).
  bool is_authorized(std::string_view authorization) const;
  /// True if a list of WebSocket subprotocols has `dismantle.1` and `token.TOKEN` (else 401).
  bool offers_token(std::string_view subprotocols) const;
  /// The value of the header Content-Security-Policy.
  static std::string_view content_security_policy();

 private:
  std::uint16_t port_;
  std::array<std::string, 3> hosts_;
  std::string token_;
};

/// The subprotocol that docs/wire.md describes.
inline constexpr std::string_view kProtocol = "dismantle.1";

}  // namespace dismantle::server
