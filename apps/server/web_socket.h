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

/// Who a socket is of.
struct SocketOwner {
  std::string key;                    ///< Of the client.
  std::shared_ptr<const void> count;  ///< As of serve_connection().
};

/// Makes a socket of a connection whose upgrade request was let through, and ties it to the hub as its client.
void serve_socket(boost::beast::tcp_stream stream,
                  const boost::beast::http::request<boost::beast::http::string_body>& upgrade, SocketOwner owner,
                  Site& site);

}  // namespace dismantle::server
