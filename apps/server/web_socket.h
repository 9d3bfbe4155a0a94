// SPDX-License-Identifier: Apache-2.0
#pragma once

// GCC 12 with C++20 needs <utility> before Beast 1.74.
#include <utility>

#include "apps/server/site.h"

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>

#include <memory>

namespace dismantle::server {

/// The client that a WebSocket belongs to.
struct SocketOwner {
  std::string key;                    ///< The client's key.
  std::shared_ptr<const void> count;  ///< As for serve_connection().
};

/// Upgrades a connection to a WebSocket and connects it to the hub until it is closed. `site` must outlive the run of
/// the io_context. @pre the upgrade request satisfies the access rules
void serve_socket(boost::beast::tcp_stream stream,
                  const boost::beast::http::request<boost::beast::http::string_body>& upgrade, SocketOwner owner,
                  Site& site);

}  // namespace dismantle::server
