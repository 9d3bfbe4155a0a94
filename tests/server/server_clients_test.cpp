// SPDX-License-Identifier: Apache-2.0
// Several clients, and clients that lose their connection and return.
#include "tests/server/server_scene.h"

namespace dismantle::server {
namespace {

using testing_client::Client;

const std::string kOtherKey = "ffeeddccbbaa99887766554433221100";

class ServerClients : public ServerScene {
 protected:
  void SetUp() override { start_with_block_and_wall(); }
};

constexpr std::chrono::milliseconds kShortPatience{400};

class ServerPatience : public ServerScene {
 protected:
  void SetUp() override {
    ServerOptions options;
    options.idle_time = kShortPatience;
    start_with_block_and_wall(std::move(options));
  }
};

TEST_F(ServerClients, LetsOneControlAndTheOthersWatch) {
  Client first(address());
  first.state();
  Client second(address(), kOtherKey);
  EXPECT_TRUE(first.event("control")["control"]);
  EXPECT_FALSE(second.event("control")["control"]);
  EXPECT_FALSE(second.command("hold", {{"components", {0}}})["ok"]);
  EXPECT_TRUE(second.command("check")["ok"]);
  const std::uint32_t grip = hold(first, 0);
  second.send_binary(target_at(grip, 1, {-9, 0, 0}));  // has no effect
  const PoseMessage pose = drag(first, grip, {}, {0, 4, 0}, 4);
  PoseMessage seen = second.pose();
  while (!(seen.pose == pose.pose)) seen = second.pose();
  first.command("release");
  EXPECT_EQ(
      second.event_where("state", [](const Json& s) { return s["hand"].is_null() && !s["moves"].empty(); })["undo"],
      "move block");
}

TEST_F(ServerClients, HandsControlOverButNotInMidDrag) {
  Client first(address());
  first.state();
  Client second(address(), kOtherKey);
  second.state();
  hold(first, 0);
  EXPECT_FALSE(second.command("take_control")["ok"]);
  first.command("release");
  second.event_where("state", [](const Json& s) { return s["number"] > 2; });
  EXPECT_TRUE(second.command("take_control")["ok"]);
  EXPECT_FALSE(first.event_where("control", [](const Json& c) { return !c["control"]; })["control"]);
  EXPECT_FALSE(first.command("hold", {{"components", {0}}})["ok"]);
  hold(second, 0);
}

TEST_F(ServerClients, KeepsADragForAClientThatComesBack) {
  Json lost_state;
  std::uint32_t grip = 0;
  {
    Client client(address());
    client.state();
    grip = hold(client, 0);
    drag(client, grip, {}, {-5, 0, 0}, 5);
    client.drop();
  }
  Client client(address());
  EXPECT_TRUE(client.event("control")["control"]);
  const Json state = client.state();
  EXPECT_EQ(state["hand"]["grip"], grip);
  EXPECT_EQ(state["components"][0]["pose"][0], -5.0);
  client.send_binary(target_at(grip, 6, {-6, 0, 0}));
  EXPECT_EQ(client.pose_for_target(6).pose.position.x, -6);
}

TEST_F(ServerClients, GivesControlOnWhenItsClientStaysAway) {
  Client watcher(address(), kOtherKey);
  watcher.state();
  const auto lost_at = std::chrono::steady_clock::now();
  {
    Client first(address());
    first.state();
    ASSERT_TRUE(first.command("take_control")["ok"]);
    const std::uint32_t grip = hold(first, 0);
    drag(first, grip, {}, {-5, 0, 0}, 5);
    first.drop();
  }
  watcher.event_where("control", [](const Json& c) { return !c["control"]; });
  watcher.event_where("control", [](const Json& c) { return c["control"]; });
  EXPECT_GE(std::chrono::steady_clock::now() - lost_at, std::chrono::seconds(10));
  const Json state =
      watcher.event_where("state", [](const Json& s) { return s["hand"].is_null() && !s["moves"].empty(); });
  EXPECT_EQ(state["undo"], "move block") << "the moving set was released in place";
  hold(watcher, 0);
}

TEST_F(ServerClients, DoesACommandOnceThatIsSentAgain) {
  std::uint64_t id = 0;
  {
    Client client(address());
    client.state();
    const std::uint32_t grip = hold(client, 0);
    drag(client, grip, {}, {-5, 0, 0}, 5);
    client.command("release");
    drag(client, hold(client, 0), {-5, 0, 0}, {-7, 0, 0}, 2);
    client.command("release");
    id = client.send_command("undo");
    client.drop();  // its response is lost
  }
  Client client(address());
  client.state();
  client.set_last_id(id - 1);
  EXPECT_EQ(client.send_command("undo"), id);
  EXPECT_TRUE(client.reply(id)["ok"]);
  EXPECT_EQ(client.state()["components"][0]["pose"][0], -5.0);  // one of the two is left
  client.set_last_id(0);
  EXPECT_TRUE(client.command("hold", {{"components", {0}}})["ok"]);  // id 1: the stored response
  EXPECT_TRUE(client.state()["hand"].is_null());
}

TEST_F(ServerClients, ReplacesASocketOfTheSameClient) {
  Client old(address());
  old.state();
  Client fresh(address());
  fresh.state();
  old.wait_for_end();
  EXPECT_TRUE(fresh.command("check")["ok"]);
  EXPECT_TRUE(fresh.command("reset")["ok"]);
}

TEST_F(ServerPatience, PingsSilentClientsAndDropsThoseThatDoNotAnswer) {
  Client listener(address());
  listener.state();
  Client deaf(address(), kOtherKey);
  deaf.state();
  listener.event_where("control", [](const Json& c) { return c["clients"] == 2; });
  listener.event_where("control", [](const Json& c) { return c["clients"] == 1; });  // `deaf` reads nothing meanwhile
  listener.idle(2 * kShortPatience);
  EXPECT_TRUE(listener.is_open());
  EXPECT_GE(listener.pings(), 2);
  EXPECT_TRUE(listener.command("check")["ok"]);
  deaf.wait_for_end();
}

TEST_F(ServerClients, SaysGoodbyeWhenItStops) {
  Client client(address());
  client.state();
  server_.reset();
  client.wait_for_end();
  EXPECT_EQ(client.close_code(), 1001u);  // going away
}

TEST_F(ServerClients, StopsWhileThingsMoveAndLoad) {
  Client client(address());
  client.state();
  client.send_command("take_out", {{"components", {0}}, {"direction", {0, 1, 0}}});
  client.send_command("open", {{"sample", "robot"}});
  client.pose();
  server_.reset();
  client.wait_for_end();
  EXPECT_EQ(client.close_code(), 1001u);  // going away
}

}  // namespace
}  // namespace dismantle::server
