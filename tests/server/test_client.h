// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/session_json.h"
#include "apps/server/wire.h"

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

/// Clients that talk to a real server over a real socket. What does not come within kPatience is an exception.
namespace dismantle::server::testing_client {

using Headers = std::map<std::string, std::string>;

inline constexpr std::chrono::seconds kPatience{60};
inline const std::string kClientKey = "00112233445566778899aabbccddeeff";

/// Where a server listens and what lets one in.
struct Door {
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

/// One request on a connection of its own, with the Host that is right unless `headers` say otherwise. A header with an
/// empty value is left out.
HttpReply request(const Door& door, const std::string& method, const std::string& target, Headers headers = {},
                  const std::string& body = {});

/// GET with the token.
HttpReply get(const Door& door, const std::string& target);

/// Sends bytes as they are and gives everything that comes back until the end, or nothing for `quiet`.
std::string exchange(const Door& door, const std::string& bytes,
                     std::chrono::milliseconds quiet = std::chrono::milliseconds(300));

/// Connects and says nothing.
class SilentConnection {
 public:
  explicit SilentConnection(const Door& door);
  ~SilentConnection();

 private:
  class Body;
  std::unique_ptr<Body> body_;
};

/// A page as docs/wire.md has it.
class Client {
 public:
  /// Connects and shakes hands; status() says whether it was let in. A header with an empty value is left out.
  explicit Client(const Door& door, std::string key = kClientKey, const Headers& headers = {});
  ~Client();
  Client(Client&&) noexcept;

  unsigned status() const;
  const std::string& protocol() const;
  bool is_open() const;
  /// How often the server has asked whether this side is there.
  int pings() const;
  /// Why the server closed it.
  unsigned close_code() const;

  void send_text(const std::string& text);
  void send_binary(const std::string& bytes);

  /// Gives a command and waits for its answer.
  Json command(const std::string& name, Json arguments = Json::object()) {
    return answer(give(name, std::move(arguments)));
  }
  /// Gives a command. @return its id
  std::uint64_t give(const std::string& name, Json arguments = Json::object());
  Json answer(std::uint64_t id);
  /// The next event of that name that was not taken yet.
  Json event(const std::string& name);
  /// Takes events of that name until there is one that `is_it`.
  template <class IsIt>
  Json event_where(const std::string& name, const IsIt& is_it) {
    for (;;)
      if (Json found = event(name); is_it(found)) return found;
  }
  /// The newest of the states that have come; waits for the first.
  Json state();
  /// The next struct `pose`.
  PoseMessage pose();
  /// Takes poses until one answers the target of that number.
  PoseMessage pose_answering(std::uint32_t number) {
    for (;;)
      if (const PoseMessage message = pose(); message.answered == number) return message;
  }
  void wait_for_end();
  /// Reads for a while what comes.
  void idle(std::chrono::milliseconds time);
  /// Breaks the connection as a lost network does.
  void drop();
  /// The id that the next command follows: as a page that comes back goes on counting.
  void set_last_id(std::uint64_t id);

 private:
  class Body;
  std::unique_ptr<Body> body_;
};

}  // namespace dismantle::server::testing_client
