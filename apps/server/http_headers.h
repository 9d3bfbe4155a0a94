// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/access_rules.h"
#include "dismantle/files/text_name.h"

#include <string>
#include <string_view>
#include <utility>

#include <boost/beast/http/fields.hpp>

namespace dismantle::server {

/// Sets the security headers of every response, also of the WebSocket handshake (docs/wire.md, "Access").
inline void add_security_headers(boost::beast::http::fields& headers) {
  headers.set("Content-Security-Policy", AccessRules::content_security_policy().data());
  headers.set("X-Content-Type-Options", "nosniff");
  headers.set("Cross-Origin-Opener-Policy", "same-origin");
  headers.set("Cross-Origin-Embedder-Policy", "require-corp");
  headers.set("Cross-Origin-Resource-Policy", "same-origin");
  headers.set("Referrer-Policy", "no-referrer");
}

/// The value of Content-Disposition for a body that browsers save under a name (RFC 6266): the name in UTF-8, and one
/// in ASCII for programs that do not know that form.
inline std::string attachment_disposition(std::string_view name) {
  constexpr std::string_view kPlain = "!#$&+-.^_`|~";  // of attr-char in RFC 8187, besides letters and digits
  std::string ascii, encoded;
  for (const char c : clean_name(name)) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = std::string_view("0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz").find(c) !=
                              std::string_view::npos ||
                          kPlain.find(c) != std::string_view::npos;
    const bool is_quotable = byte >= 0x20 && byte < 0x7f && c != '"' && c != '\\' && c != '/' && c != '%';
    ascii += is_quotable ? c : '_';
    if (is_plain) {
      encoded += c;
    } else {
      encoded += '%';
      encoded += "0123456789ABCDEF"[byte >> 4];
      encoded += "0123456789ABCDEF"[byte & 15];
    }
  }
  std::string value = "attachment; filename=\"" + ascii + '"';
  if (ascii != encoded) value += "; filename*=UTF-8''" + encoded;
  return value;
}

}  // namespace dismantle::server
