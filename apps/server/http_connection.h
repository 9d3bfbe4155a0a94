// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/site.h"

#include <boost/asio/ip/tcp.hpp>

#include <memory>

namespace dismantle::server {

/// Serves the requests of a connection until it ends or becomes a socket. `site` must outlive the io_context's run.
/// Requests that break a rule of docs/wire.md are answered before anything of their body is read.
/// @param count held as long as the connection is: its owner counts the holders
void serve_connection(boost::asio::ip::tcp::socket socket, Site& site, std::shared_ptr<const void> count);

}  // namespace dismantle::server
