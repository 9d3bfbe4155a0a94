// SPDX-License-Identifier: Apache-2.0
// The bytes of one connection to the viewer: requests, uploads, an upgrade, frames. They arrive in pieces, as the first
// two bytes say; then the client says no more. Everything after the kernel's socket is the viewer's; commands have a
// target of their own (fuzz_commands), as have targets and binary frames (fuzz_wire).
#include "fuzz/fuzz_input.h"
#include "fuzz/http_answers.h"
#include "fuzz/http_change.h"
#include "fuzz/http_site.h"
#include "fuzz/own_folder.h"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>

namespace {

using namespace dismantle;
namespace fs = std::filesystem;

constexpr int kSettled = 100;  // rounds without an event until a connection is at rest, at most
constexpr std::size_t kMostAnswered = std::size_t{64} << 20;

/// The page's files, what lies outside them, and the folder for uploads.
struct Folders {
  fuzz::OwnFolder own;
  fs::path page = own.folder("page"), temporary = own.folder("temporary");

  Folders() {
    setenv("TMPDIR", temporary.c_str(), 1);
    std::ofstream(page / "index.html") << "<title>page</title>";
    std::ofstream(own.path() / "secret.html") << fuzz::kSecret;
    fs::create_symlink(own.path() / "secret.html", page / "link.html");
    fs::create_directory_symlink(own.path(), page / "up");
  }
};

/// The two ends of a connection; the server's is closed by the server.
class Connection {
 public:
  explicit Connection(fuzz::HttpSite& site) : site_(site) {
    int ends[2] = {-1, -1};
    fuzz::require(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends) == 0, "a pair of sockets");
    client_ = ends[0];
    boost::asio::ip::tcp::socket socket(site.io(), boost::asio::ip::tcp::v4(), ends[1]);
    server::serve_connection(std::move(socket), site, count_);
  }
  ~Connection() { close(client_); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Sends bytes and lets the server take them. @return false once it has closed the connection
  bool send(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t count = ::send(client_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (count < 0 && errno != EAGAIN) return settle(), false;
      if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
      settle();
    }
    return true;
  }
  /// Says that nothing more comes.
  void end() {
    shutdown(client_, SHUT_WR);
    settle();
  }
  /// Lets the server do all that it can do.
  void settle() {
    for (int quiet = 0; quiet < 2; ++quiet) {
      site_.io().restart();
      if (site_.io().poll() > 0) quiet = -1;
      if (receive()) quiet = -1;
      if (quiet < 0) continue;
    }
  }

  const std::string& received() const { return received_; }
  bool is_closed_by_server() const { return closed_; }
  /// True once nothing of the server holds the connection.
  bool is_forgotten() const { return count_.use_count() == 1; }

 private:
  bool receive() {
    char buffer[16384];
    const ssize_t count = closed_ ? -1 : ::recv(client_, buffer, sizeof buffer, 0);
    if (count == 0 || (count < 0 && !closed_ && errno != EAGAIN)) return closed_ = true;
    if (count < 0) return false;
    received_.append(buffer, static_cast<std::size_t>(count));
    fuzz::require(received_.size() < kMostAnswered, "answers of a size that the requests explain");
    return true;
  }

  fuzz::HttpSite& site_;
  std::shared_ptr<const int> count_ = std::make_shared<const int>(0);
  int client_ = -1;
  std::string received_;
  bool closed_ = false;
};

/// The sizes of the pieces in which bytes arrive.
class Pieces {
 public:
  Pieces(std::uint8_t kind, std::uint8_t seed) : kind_(kind % 4), choices_(seed + 1u) {}
  std::size_t next() {
    static constexpr std::size_t kLongest[] = {0, 1, 40, 3000};
    return kind_ == 0 ? std::string::npos : 1 + choices_.below(kLongest[kind_]);
  }

 private:
  std::size_t kind_;
  fuzz::Choices choices_;
};

bool has_token(const fuzz::HttpHead& request) {
  for (const std::string& value : request.all("authorization"))
    if (value == "Bearer " + fuzz::kToken) return true;
  for (const std::string& value : request.all("sec-websocket-protocol"))
    if (value.find("token." + fuzz::kToken) != std::string::npos) return true;
  return false;
}

void require_allowed(const fuzz::HttpAnswer& answer, const fuzz::HttpHead& request) {
  const std::vector<std::string> hosts = request.all("host");
  const bool own_host =
      hosts.size() == 1 && (hosts[0] == "127.0.0.1:1234" || hosts[0] == "localhost:1234" || hosts[0] == "[::1]:1234");
  fuzz::require(own_host || answer.status == 421, "nothing under another name");
  const bool is_private =
      answer.status == 101 || answer.status == 202 || answer.body.find(fuzz::kSecret) != std::string::npos;
  if (is_private) fuzz::require(has_token(request), "nothing but the page without the token");
  if (answer.status == 202) {
    const std::vector<std::string> clients = request.all("x-client");
    fuzz::require(!clients.empty() && clients[0] == fuzz::kController, "uploads of who is in control only");
  }
  if (answer.status == 101) {
    const std::vector<std::string> origins = request.all("origin");
    fuzz::require(origins.size() == 1 && origins[0].ends_with(":1234"), "no socket for other sites");
  }
  if (answer.status >= 400) {
    const auto json = nlohmann::json::parse(answer.body, nullptr, false);
    fuzz::require(request.first_line.starts_with("HEAD ") || (json.is_object() && json.contains("error")),
                  "an error as JSON");
  }
  if (request.first_line.starts_with("HEAD ")) fuzz::require(answer.body.empty(), "no body for HEAD");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folders folders;
  if (size < 2) return 0;
  Pieces pieces(data[0], data[1]);
  const std::string sent(fuzz::text_of(data + 2, size - 2));
  {
    fuzz::HttpSite site(folders.page);
    Connection connection(site);
    for (std::size_t at = 0; at < sent.size();) {
      const std::size_t piece = std::min(pieces.next(), sent.size() - at);
      if (!connection.send(std::string_view(sent).substr(at, piece))) break;
      at += piece;
    }
    site.wait_for_engine();
    connection.settle();
    connection.end();
    for (int round = 0; round < kSettled && !connection.is_forgotten(); ++round) {
      site.wait_for_engine();
      connection.settle();
    }
    fuzz::require(connection.is_forgotten() && connection.is_closed_by_server(),
                  "a connection that ends with its client");
    fuzz::require(site.hub().client_count() == 1, "no client without a socket");
    for (const fs::directory_entry& store : fs::directory_iterator(folders.temporary))
      fuzz::require(fs::is_empty(store.path()), "no upload that is left behind");

    const std::vector<fuzz::HttpHead> requests = fuzz::requests_in(sent);
    const fuzz::Received received = fuzz::answers_in(connection.received(), requests);
    for (std::size_t i = 0; i < received.answers.size(); ++i) require_allowed(received.answers[i], requests[i]);
    fuzz::require_messages(fuzz::frames_in(received.frames));
  }
  fuzz::require(fs::is_empty(folders.temporary), "no folder that is left behind");
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  return dismantle::fuzz::mutate_text<dismantle::fuzz::HttpChange>(data, size, max_size, seed);
}
