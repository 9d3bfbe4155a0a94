// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/session_json.h"
#include "apps/server/wire.h"

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

/// Clients of a real server over a real socket. Waiting for longer than kPatience throws.
namespace dismantle::server::testing_client {

using Headers = std::map<std::string, std::string>;

inline constexpr std::chrono::seconds kPatience{60};
inline const std::string kClientKey = "00112233445566778899aabbccddeeff";

/// A server's address and token.
struct ServerAddress {
  std::uint16_t port = 0;
  std::string token;
  std::string host() const { return "127.0.0.1:" + std::to_string(port); }
  std::string origin() const { return "http://" + host(); }
};

struct HttpReply {
  unsigned status = 0;
  std::string body;
  Headers headers;
};

/// One request on a new connection, with the correct Host unless `headers` has another. A header with an empty value is
/// omitted.
HttpReply request(const ServerAddress& address, const std::string& method, const std::string& target,
                  Headers headers = {}, const std::string& body = {});

/// A GET request with the token.
HttpReply get(const ServerAddress& address, const std::string& target);

/// Sends bytes unchanged. @return everything received until the connection ends or is silent for `quiet`
std::string exchange(const ServerAddress& address, const std::string& bytes,
                     std::chrono::milliseconds quiet = std::chrono::milliseconds(300));

/// A connection that sends what it is told to.
class RawConnection {
 public:
  /// Connects and sends nothing.
  explicit RawConnection(const ServerAddress& address);
  ~RawConnection();
  /// Sends bytes. @return false if the server has closed the connection
  bool send(const std::string& bytes);
  /// Everything received until the connection ends or is silent for `quiet`.
  std::string receive(std::chrono::milliseconds quiet = std::chrono::milliseconds(300));
  /// True if receive() or send() found that the server has closed the connection.
  bool is_closed() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// A client as docs/wire.md describes it.
class Client {
 public:
  /// Connects and performs the handshake; status() tells whether it was accepted. A header with an empty value is
  /// omitted.
  explicit Client(const ServerAddress& address, std::string key = kClientKey, const Headers& headers = {});
  ~Client();
  Client(Client&&) noexcept;

  unsigned status() const;
  const std::string& protocol() const;
  bool is_open() const;
  /// The number of pings received.
  int pings() const;
  /// The close code sent by the server.
  unsigned close_code() const;

  void send_text(const std::string& text);
  void send_binary(const std::string& bytes);

  /// Sends a command and waits for its response.
  Json command(const std::string& name, Json arguments = Json::object()) {
    return reply(send_command(name, std::move(arguments)));
  }
  /// Sends a command. @return its id
  std::uint64_t send_command(const std::string& name, Json arguments = Json::object());
  /// Waits for the reply to a command.
  Json reply(std::uint64_t id);
  /// The next unread event of that name.
  Json event(const std::string& name);
  /// Reads events of that name until `is_it`.
  template <class IsIt>
  Json event_where(const std::string& name, const IsIt& is_it) {
    for (;;)
      if (Json found = event(name); is_it(found)) return found;
  }
  /// The latest state received; waits for the first.
  Json state();
  /// The next struct `pose`.
  PoseMessage pose();
  /// Reads poses until the one for the target of that number.
  PoseMessage pose_for_target(std::uint32_t number) {
    for (;;)
      if (const PoseMessage message = pose(); message.answered == number) return message;
  }
  void wait_for_end();
  /// Reads messages for a while.
  void idle(std::chrono::milliseconds time);
  /// Breaks the connection as a network failure does.
  void drop();
  /// Sets the id before that of the next command, like a page that reconnects.
  void set_last_id(std::uint64_t id);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dismantle::server::testing_client
