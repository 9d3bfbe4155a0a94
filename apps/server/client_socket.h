// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

namespace dismantle::server {

/// Bytes that are sent to several clients.
using SharedText = std::shared_ptr<const std::string>;

/// Why the server closes a socket.
enum class CloseReason {
  Stopping,   ///< The server stops.
  Replaced,   ///< The same client has connected again.
  Malformed,  ///< The client sent too many malformed messages.
};

/// The connection to one client. For the network's thread.
class ClientSocket {
 public:
  virtual ~ClientSocket() = default;
  /// Queues a text message; drops the connection if too much is queued already.
  virtual void send_text(SharedText text) = 0;
  /// Sends a struct `pose` after the queued texts; replaces one that has not been sent yet.
  virtual void send_pose(SharedText bytes) = 0;
  /// Closes the connection with the WebSocket close code of the reason.
  virtual void close(CloseReason reason) = 0;
};

}  // namespace dismantle::server
