// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/model_loader.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dismantle::server {

struct ServerOptions {
  std::uint16_t port = 0;                    ///< 0: one that is free.
  std::vector<std::filesystem::path> roots;  ///< Folders whose files clients may open, and save recordings in.
  ModelOptions model;
  std::optional<std::filesystem::path> state_folder;  ///< For the sessions' journals and the list of recent files.
  std::optional<std::filesystem::path> web_folder;    ///< The page's files are there, not in the program.
  /// A socket that says nothing is pinged after half of this, and dropped where it does not answer in the other half.
  std::chrono::milliseconds idle_time{20'000};
};

/// The viewer's server (docs/wire.md): on the loopback addresses only, with a token that is new each
/// time. It runs on threads of its own until it is stopped.
class Server {
 public:
  /// Starts listening. Errors: Failed if the port is taken; Usage if a root is not a folder.
  static Result<std::unique_ptr<Server>> start(ServerOptions options);
  /// Stops: closes sockets, ends the present drag, cancels imports.
  ~Server();

  std::uint16_t port() const;
  const std::string& token() const;
  /// "http://127.0.0.1:PORT/#token=HEX"
  std::string url() const;
  /// Opens an assembly, as a client could; clients are told how it goes. Errors: Usage where one is being opened.
  Result<Done> open_file(const std::filesystem::path& file);
  /// As open_file(), and opens a path file as the guide once the assembly is there.
  Result<Done> open_guided(const std::filesystem::path& file, const std::filesystem::path& guide);
  /// Opens a bundled sample. Errors: as open_file; Usage where there is none of that name.
  Result<Done> open_sample(const std::string& name);

 private:
  class Body;
  explicit Server(std::unique_ptr<Body> body);
  std::unique_ptr<Body> body_;
};

}  // namespace dismantle::server
