// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/access_rules.h"

#include <utility>

#include <boost/beast/http/fields.hpp>

namespace dismantle::server {

/// The headers that every answer has, the socket's handshake too (docs/wire.md, "Doors").
inline void add_safety_headers(boost::beast::http::fields& headers) {
  headers.set("Content-Security-Policy", AccessRules::content_security_policy().data());
  headers.set("X-Content-Type-Options", "nosniff");
  headers.set("Cross-Origin-Opener-Policy", "same-origin");
  headers.set("Cross-Origin-Embedder-Policy", "require-corp");
  headers.set("Cross-Origin-Resource-Policy", "same-origin");
  headers.set("Referrer-Policy", "no-referrer");
}

}  // namespace dismantle::server
