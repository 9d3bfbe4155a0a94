// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/client_socket.h"
#include "apps/server/engine_loop.h"
#include "apps/server/reply_store.h"

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace dismantle::server {

/// Counters of the network, for the command `metrics`.
struct HubCounters {
  std::uint64_t pose_frames = 0;     ///< Structs `pose` from the engine.
  std::uint64_t dropped_frames = 0;  ///< Poses replaced by newer ones before they were sent, counted for each client.
  std::uint64_t bytes_in = 0;        ///< Bytes of messages received.
  std::uint64_t bytes_out = 0;       ///< Bytes sent.
  std::uint64_t refused = 0;         ///< Requests rejected because of Host, Origin, token or target.
};

/// Commands that the server executes itself, without the engine: files and imports. For the network's thread.
class ServerCommands {
 public:
  virtual ~ServerCommands() = default;
  /// True if it executes commands of this name.
  virtual bool knows(std::string_view command) const = 0;
  /// True if only the client in control may send the command. @pre knows(command)
  virtual bool needs_control(std::string_view command) const = 0;
  /// Executes a command. @return the members of its reply, or the error. @pre knows(command["command"])
  virtual Result<Json> execute(const Json& command) = 0;
};

/// The clients of the server: routes their commands and inputs, stores the replies for clients that reconnect, decides
/// which client is in control, and broadcasts events and poses. For the network's thread.
class Hub {
 public:
  /// The clock of tick().
  using Clock = std::chrono::steady_clock;
  /// Queues a function, which runs on the network's thread. Called from any thread.
  using Post = std::function<void(std::function<void()>)>;

  /// A hub without clients. `engine` and `commands` must outlive it.
  Hub(EngineLoop& engine, ServerCommands& commands, Post post);

  /// Adds the socket of a new or a returning client, and sends it the events that docs/wire.md lists. A previous socket
  /// of the client is closed. `socket` must live until disconnect() or until it is replaced.
  void connect(const std::string& key, ClientSocket& socket);
  /// Removes a closed socket; ignored if the client has connected again since.
  void disconnect(const std::string& key, ClientSocket& socket);
  /// Executes a text message of a client: a command.
  void receive_text(const std::string& key, std::string_view text);
  /// Processes a binary message of a client: a target or a velocity, ignored unless the client is in control.
  void receive_binary(const std::string& key, std::string_view bytes);

  /// Sends an event to all clients.
  void broadcast_event(EngineEvent event);
  /// Sends an encoded struct `pose` to all clients.
  void broadcast_pose(std::string bytes);
  /// Sends an event `job` to all clients, and to those that connect while the job runs.
  void broadcast_job(std::uint32_t job, std::string text, bool running);
  /// Keeps an event for the client that connects next, if none is connected.
  void keep_if_unheard(const SharedText& text);
  /// Passes on the control of a client that has been disconnected for too long, and forgets old clients. Call about
  /// once a second.
  void tick(Clock::time_point now);
  /// Closes all sockets.
  void close_all(CloseReason reason);

  /// True if the client is in control.
  bool is_in_control(const std::string& key) const { return key == controller_; }
  /// Number of connected clients.
  std::size_t client_count() const;
  /// Number of clients that may come back: their replies and control are kept.
  std::size_t absent_count() const { return clients_.size() - client_count(); }
  /// The replies that are kept for clients that come back.
  const ReplyStore& replies() const { return replies_; }
  /// Counters, which the connections update too.
  HubCounters& counters() { return counters_; }
  /// Sets the event `hello`. @pre called before the first client connects
  void set_hello(const Json& hello);

 private:
  struct Client {
    ClientSocket* socket = nullptr;  ///< null: not connected
    std::uint64_t last_id = 0;       ///< Of the newest command.
    int malformed_messages = 0;      ///< Since the client connected.
    std::uint64_t order = 0;         ///< Position among the clients, by first connection.
    Clock::time_point disconnected_at;
  };

  void receive_command(const std::string& key, Client& client, const Json& command, std::size_t bytes);
  void run_command(const std::string& key, std::uint64_t id, const Json& command, std::size_t bytes);
  void post_to_engine(const std::string& key, std::uint64_t id, const Json& command, std::size_t bytes);
  void reply_metrics(const std::string& key, std::uint64_t id, Json engine);
  void reply(const std::string& key, std::uint64_t id, const Result<Json>& result);
  void broadcast(const SharedText& event);
  static void report_malformed(Client& client, const std::string& why);
  Result<Json> take_control(const std::string& key);
  /// Hands control over; to the client that has been known longest if `key` is empty. @return false if the engine is
  /// too busy
  bool give_control(const std::string& key);
  void forget(const std::string& key);
  void forget_long_absent();
  void send_control();

  EngineLoop& engine_;
  ServerCommands& commands_;
  Post post_;
  Clock::time_point started_ = Clock::now();
  std::map<std::string, Client> clients_;
  ReplyStore replies_;
  std::size_t pending_bytes_ = 0;  ///< Of the commands that the engine has not executed yet.
  std::string controller_;
  bool dragging_ = false;  ///< As of the last event `state`.
  std::uint64_t known_clients_ = 0;
  SharedText hello_, model_;
  std::map<std::uint32_t, SharedText> jobs_;
  std::deque<SharedText> unheard_;  ///< Events `log` from when no client was connected.
  HubCounters counters_;
};

}  // namespace dismantle::server
