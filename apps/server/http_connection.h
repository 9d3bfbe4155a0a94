// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/site.h"

#include <boost/asio/ip/tcp.hpp>

#include <memory>

namespace dismantle::server {

/// Serves the requests of a connection until it is closed or upgraded to a WebSocket. `site` must outlive the run of
/// the io_context. Requests that break a rule of docs/wire.md are rejected before their body is read.
/// @param count held for the lifetime of the connection: its use count gives the number of connections
void serve_connection(boost::asio::ip::tcp::socket socket, Site& site, std::shared_ptr<const void> count);

}  // namespace dismantle::server
