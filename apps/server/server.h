// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/model_loader.h"
#include "apps/server/upload_store.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dismantle::server {

/// Options of the viewer's server.
struct ServerOptions {
  std::uint16_t port = 0;                             ///< Port on the loopback addresses; 0: a free one.
  std::vector<std::filesystem::path> roots;           ///< Folders whose files clients may open, and save recordings in.
  ModelOptions model;                                 ///< For loading assemblies.
  std::optional<std::filesystem::path> state_folder;  ///< For journals and recent files; none: not stored.
  std::optional<std::filesystem::path> web_folder;    ///< Serves the page from this folder; none: embedded.
  UploadLimits uploads;                               ///< How much of the disk uploads may take.
  /// A silent WebSocket is pinged after half of this time, and dropped if there is no response in the other half.
  std::chrono::milliseconds idle_time{20'000};
};

/// The viewer's server (docs/wire.md): on the loopback addresses only, with a new token in every run. It runs on
/// threads of its own until it is destroyed. Its functions may be called from one thread at a time.
class Server {
 public:
  /// Starts listening. Errors: Failed if the port is taken; Usage if a root is not a folder.
  static Result<std::unique_ptr<Server>> start(ServerOptions options);
  /// Closes all connections, ends the session, and cancels jobs. Blocks until all threads have ended.
  ~Server();

  /// The port that it listens on.
  std::uint16_t port() const;
  /// The token that clients must send: 32 hexadecimal digits.
  const std::string& token() const;
  /// The URL of the page: "http://127.0.0.1:PORT/#token=HEX"
  std::string url() const;
  /// Starts loading an assembly; clients receive the job's events. Errors: Usage if another job is running.
  Result<Done> open_file(const std::filesystem::path& file);
  /// As open_file(), and opens a path file as the guide when the assembly is loaded. @pre nothing was opened before
  Result<Done> open_guided(const std::filesystem::path& file, const std::filesystem::path& guide);
  /// Starts loading a bundled sample. Errors: as open_file; Usage if there is none of that name.
  Result<Done> open_sample(const std::string& name);

 private:
  class Impl;
  explicit Server(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace dismantle::server
