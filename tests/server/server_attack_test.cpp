// SPDX-License-Identifier: Apache-2.0
// The attacks of tests/server/attack_server.cpp that take less than a second each.
#include "tests/server/attacks.h"
#include "tests/server/server_scene.h"

namespace dismantle::server {
namespace {

using testing_client::AttackResult;
using testing_client::Client;

class ServerAttack : public ServerScene {
 protected:
  void SetUp() override {
    start_with_block_and_wall();
    Client(address()).state();
  }
  /// Expects that the server answered as it should, and that it does what its owner wants as before.
  void expect_held(const AttackResult& result) const {
    EXPECT_FALSE(result.answers.empty());
    for (const std::string& failure : result.failures) ADD_FAILURE() << failure;
    Client owner(address(), "0123456789abcdef0123456789abcdef");
    owner.state();
    EXPECT_TRUE(owner.command("take_control")["ok"]);
    hold(owner, 0);
    EXPECT_TRUE(owner.command("release")["ok"]);
  }
};

TEST_F(ServerAttack, ByHost) {
  expect_held(testing_client::attack_by_host(address()));
}

TEST_F(ServerAttack, ByOrigin) {
  expect_held(testing_client::attack_by_origin(address()));
}

TEST_F(ServerAttack, ByToken) {
  expect_held(testing_client::attack_by_token(address(), 10));
}

TEST_F(ServerAttack, ByHttp) {
  expect_held(testing_client::attack_by_http(address()));
}

TEST_F(ServerAttack, ByFrames) {
  expect_held(testing_client::attack_by_frames(address()));
}

TEST_F(ServerAttack, ByPaths) {
  std::filesystem::create_directories(folder_ / "outside");
  expect_held(testing_client::attack_by_paths(address(), root(), folder_ / "outside"));
}

TEST_F(ServerAttack, ByManyClients) {
  expect_held(testing_client::attack_by_many_clients(address(), 500));
  Client client(address());
  client.state();
  EXPECT_LT(client.command("metrics")["absent_clients"], 300);
}

TEST_F(ServerAttack, ByLargeCommands) {
  expect_held(testing_client::attack_by_large_commands(address(), 20));
}

}  // namespace
}  // namespace dismantle::server
