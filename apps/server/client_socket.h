// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

namespace dismantle::server {

/// Bytes that several clients are sent.
using SharedText = std::shared_ptr<const std::string>;

/// Why the server closes a socket.
enum class CloseReason {
  Stopping,   ///< The server ends.
  Replaced,   ///< The same client has connected anew.
  Malformed,  ///< It sent too much that could not be understood.
};

/// The line to one connected client.
class ClientSocket {
 public:
  virtual ~ClientSocket() = default;
  /// Queues a text message; closes the socket where too much is queued already.
  virtual void send_text(SharedText text) = 0;
  /// Sends a struct `pose` when the line is free; takes the place of one that waits.
  virtual void send_pose(SharedText bytes) = 0;
  virtual void close(CloseReason reason) = 0;
};

}  // namespace dismantle::server
