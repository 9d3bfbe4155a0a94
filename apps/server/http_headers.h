// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/access_rules.h"

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

}  // namespace dismantle::server
