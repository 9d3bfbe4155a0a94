// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/server.h"
#include "dismantle/io/write_assembly.h"
#include "tests/io/scratch_folder.h"
#include "tests/server/test_client.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <memory>

/// A server in this process with a root of its own.
namespace dismantle::server {

class ServerScene : public testing::Test {
 protected:
  void start() {
    ServerOptions options;
    options.roots = {folder_.path()};
    Result<std::unique_ptr<Server>> started = Server::start(std::move(options));
    ASSERT_TRUE(started.ok()) << (started.ok() ? "" : started.error().message);
    server_ = std::move(*started);
    door_ = {server_->port(), server_->token()};
  }
  /// Writes block.obj into the root: a block of 10 mm, 10.5 mm in front of a wall; and opens it.
  void start_with_block_and_wall() {
    write_block_and_wall();
    start();
    ASSERT_TRUE(server_->open_file(folder_.path() / "block.obj").ok());
  }
  void write_block_and_wall() const {
    const Assembly assembly =
        scenes::assembly({scenes::component("block", scenes::box({0, 0, 0}, {10, 10, 10})),
                          scenes::component("wall", scenes::box({20.5, -50, -50}, {21, 50, 50}))});
    ASSERT_TRUE(write_assembly(folder_.path() / "block.obj", assembly).ok());
  }
  const testing_client::Door& door() const { return door_; }
  std::filesystem::path folder() const { return folder_.path(); }

  ScratchFolder folder_;
  std::unique_ptr<Server> server_;
  testing_client::Door door_;
};

/// A target at a position, not turned.
inline std::string target_at(std::uint32_t grip, std::uint32_t number, const Vec3& position) {
  return encode(TargetMessage{grip, number, {position, {}}});
}

}  // namespace dismantle::server
