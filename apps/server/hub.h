// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/client_socket.h"
#include "apps/server/engine_loop.h"

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace dismantle::server {

/// Counters of the network.
struct HubCounters {
  std::uint64_t pose_frames = 0;     ///< Structs `pose` that the engine made.
  std::uint64_t dropped_frames = 0;  ///< Of them, times clients: overtaken by newer ones before they were sent.
  std::uint64_t bytes_in = 0, bytes_out = 0;
  std::uint64_t refused = 0;  ///< Requests and sockets without the right Host, Origin or token.
};

/// The commands that are the server's and not the engine's: files, imports.
class ServerCommands {
 public:
  virtual ~ServerCommands() = default;
  virtual bool knows(std::string_view command) const = 0;
  /// True if it changes nothing that others see, so that every client may send it.
  virtual bool is_question(std::string_view command) const = 0;
  /// @pre knows(command["command"])
  virtual Result<Json> execute(const Json& command) = 0;
};

/// The clients of the server: who is in control, what each was answered, what those who come later must be told.
/// Everything on the network's thread.
class Hub {
 public:
  using Clock = std::chrono::steady_clock;
  /// Runs something on the network's thread.
  using Post = std::function<void(std::function<void()>)>;

  Hub(EngineLoop& engine, ServerCommands& commands, Post post);

  /// A client is there (again). Sends it what it must know.
  void connect(const std::string& key, ClientSocket& socket);
  /// A socket is gone.
  void disconnect(const std::string& key, ClientSocket& socket);
  void take_text(const std::string& key, std::string_view text);
  void take_binary(const std::string& key, std::string_view bytes);

  void broadcast_event(EngineEvent event);
  void broadcast_pose(std::string bytes);
  /// An event `job`: as broadcast_event(), and told to those who come while the job runs.
  void broadcast_job(std::uint32_t job, std::string text, bool running);
  /// To be called now and then: gives control away whose client was gone for too long.
  void tick(Clock::time_point now);
  void close_all(CloseReason reason);

  bool is_in_control(const std::string& key) const { return key == controller_; }
  std::size_t client_count() const;
  HubCounters& counters() { return counters_; }
  /// The event `hello`. @pre set before the first client connects
  void set_greeting(const Json& hello);

 private:
  struct Client {
    ClientSocket* socket = nullptr;               ///< null: not connected
    std::uint64_t last_id = 0;                    ///< Of the newest command.
    std::map<std::uint64_t, SharedText> answers;  ///< Of the last commands.
    int faults = 0;
    std::uint64_t arrival = 0;  ///< Clients in the order in which they came first.
    Clock::time_point lost_at;
  };

  void take_command(const std::string& key, Client& client, const Json& command);
  void run_command(const std::string& key, std::uint64_t id, const Json& command);
  void ask_engine(const std::string& key, std::uint64_t id, const Json& command);
  void answer_metrics(const std::string& key, std::uint64_t id, Json engine);
  void answer(const std::string& key, std::uint64_t id, const Result<Json>& result);
  void broadcast(const SharedText& event);
  static void fault(Client& client, const std::string& why);
  Result<Json> take_control(const std::string& key);
  void give_control(const std::string& key);
  void send_control();

  EngineLoop& engine_;
  ServerCommands& commands_;
  Post post_;
  Clock::time_point started_ = Clock::now();
  std::map<std::string, Client> clients_;
  std::string controller_;
  bool dragging_ = false;  ///< As the last event `state` said.
  std::uint64_t arrivals_ = 0;
  SharedText hello_, model_;
  std::map<std::uint32_t, SharedText> jobs_;
  HubCounters counters_;
};

}  // namespace dismantle::server
