// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/server.h"
#include "dismantle/audit/audit_path.h"
#include "dismantle/documents/path_file.h"
#include "dismantle/loading/load_assembly.h"
#include "dismantle/loading/write_assembly.h"
#include "tests/server/test_client.h"
#include "tests/support/meshes.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <memory>

/// A server in this process with a separate root folder.
namespace dismantle::server {

/// A target at a position, without rotation.
inline std::string target_at(std::uint32_t grip, std::uint32_t number, const Vec3& position) {
  return encode(TargetMessage{grip, number, {position, {}}});
}

class ServerScene : public testing::Test {
 protected:
  void start(ServerOptions options = {}) {
    std::filesystem::create_directories(root());
    options.roots = {root()};
    options.state_folder = folder_ / "state";
    Result<std::unique_ptr<Server>> started = Server::start(std::move(options));
    ASSERT_TRUE(started.ok()) << (started.ok() ? "" : started.error().message);
    server_ = std::move(*started);
    address_ = {server_->port(), server_->token()};
  }
  std::filesystem::path root() const { return folder_ / "root"; }
  /// Writes block.obj into the root: a block of 10 mm, 10.5 mm in front of a wall; and opens it.
  void start_with_block_and_wall(ServerOptions options = {}) {
    write_block_and_wall();
    start(std::move(options));
    ASSERT_TRUE(server_->open_file(root() / "block.obj").ok());
  }
  void write_block_and_wall() const {
    std::filesystem::create_directories(root());
    const Assembly assembly =
        scenes::assembly({scenes::component("block", scenes::box({0, 0, 0}, {10, 10, 10})),
                          scenes::component("wall", scenes::box({20.5, -50, -50}, {21, 50, 50}))});
    ASSERT_TRUE(write_assembly(root() / "block.obj", assembly).ok());
  }
  /// Grabs a component. @return the grip
  static std::uint32_t hold(testing_client::Client& client, std::uint32_t component) {
    const Json reply = client.command("hold", {{"components", {component}}});
    EXPECT_TRUE(reply["ok"]) << reply;
    return reply.value("grip", 0u);
  }
  /// Drags along a straight line in steps, waiting for each pose.
  static PoseMessage drag(testing_client::Client& client, std::uint32_t grip, const Vec3& from, const Vec3& to,
                          std::uint32_t steps) {
    PoseMessage last;
    for (std::uint32_t i = 1; i <= steps; ++i) {
      client.send_binary(target_at(grip, i, from + (static_cast<double>(i) / steps) * (to - from)));
      last = client.pose_for_target(i);
    }
    return last;
  }
  /// The recording, which must pass the audit.
  Path audited_recording() const {
    const testing_client::HttpReply reply = testing_client::get(address(), "/api/path.json");
    const Result<Path> path = parse_path(reply.body, "recording");
    EXPECT_TRUE(path.ok()) << reply.body;
    const Result<Assembly> assembly = load_assembly(root() / "block.obj");
    EXPECT_TRUE(audit_path(*assembly, *path).holds());
    return *path;
  }
  const testing_client::ServerAddress& address() const { return address_; }

  ScratchFolder folder_;
  std::unique_ptr<Server> server_;
  testing_client::ServerAddress address_;
};

}  // namespace dismantle::server
