// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/client_socket.h"

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <optional>
#include <string>

namespace dismantle::server {

/// Limits of a ReplyStore.
struct ReplyLimits {
  std::size_t client_replies = 256;                 ///< Replies of one client.
  std::size_t total_bytes = std::size_t{64} << 20;  ///< Of all clients [bytes], with kReplyOverhead for each.
};

/// Memory of a reply besides its text [bytes]: an upper bound for its nodes in the store.
inline constexpr std::size_t kReplyOverhead = 512;

/// The last replies to the commands of each client, for clients that lose their connection and repeat a command. The
/// oldest ones are forgotten first.
class ReplyStore {
 public:
  /// An empty store.
  explicit ReplyStore(ReplyLimits limits = {}) : limits_(limits) {}

  /// Adds a command whose reply is pending. @pre ids of a client ascend
  void add_pending(const std::string& client, std::uint64_t id);
  /// Sets the reply to a command; ignored if the command is not in the store.
  void set(const std::string& client, std::uint64_t id, SharedText text);
  /// The reply to a command: null while it is pending; none if it is not in the store.
  std::optional<SharedText> find(const std::string& client, std::uint64_t id) const;
  /// Forgets all replies of a client.
  void forget(const std::string& client);
  /// Memory of all replies [bytes].
  std::size_t bytes() const { return bytes_; }

 private:
  struct Entry {
    std::string client;
    std::uint64_t id = 0;
    SharedText text;  ///< null: pending
  };
  using Place = std::list<Entry>::iterator;

  void erase(Place place);

  ReplyLimits limits_;
  std::list<Entry> entries_;  ///< Oldest first.
  std::map<std::string, std::map<std::uint64_t, Place>> clients_;
  std::size_t bytes_ = 0;
};

}  // namespace dismantle::server
