// SPDX-License-Identifier: Apache-2.0
// Searches of the planner for a page, over a real socket.
#include "tests/planner/plan_scenes.h"
#include "tests/server/server_scene.h"

namespace dismantle::server {
namespace {

using testing_client::Client;

/// Components of a stack of three in a tube; the tube is 0.
constexpr std::uint32_t kTube = 0, kLow = 1, kMiddle = 2, kHigh = 3;

class ServerSearch : public ServerScene {
 protected:
  void start_with(const Assembly& assembly) {
    std::filesystem::create_directories(root());
    ASSERT_TRUE(write_assembly(root() / "block.obj", assembly).ok());
    start();
    ASSERT_TRUE(server_->open_file(root() / "block.obj").ok());
  }
  /// Gives a command that starts a search and waits for its end. @return its last event
  static Json search(Client& client, const std::string& name, const Json& arguments) {
    const Json reply = client.command(name, arguments);
    EXPECT_TRUE(reply["ok"]) << reply;
    return client.event_where("job",
                              [&](const Json& j) { return j["job"] == reply["job"] && j["status"] != "running"; });
  }
  static Json state_where(Client& client, const char* member) {
    return client.event_where("state", [member](const Json& s) { return !s[member].is_null(); });
  }
  /// The state after an automatic motion has started and ended.
  static Json after_motion(Client& client) {
    state_where(client, "automatic");
    return client.event_where("state", [](const Json& s) { return s["automatic"].is_null(); });
  }
};

TEST_F(ServerSearch, MakesThePlanTheGuide) {
  start_with(scenes::stack_in_tube(3));
  Client client(address());
  client.state();
  EXPECT_EQ(search(client, "plan", {})["status"], "done");
  const Json state = state_where(client, "search");
  EXPECT_EQ(state["search"]["kind"], "plan");
  EXPECT_TRUE(state["search"]["complete"]);
  EXPECT_EQ(state["search"]["steps"], 3);
  EXPECT_EQ(state["guide"]["name"], "plan.path.json");
  EXPECT_EQ(state["guide"]["moves"].size(), 3u);
  EXPECT_EQ(state["components"][kHigh], Json::object());  // planning moves nothing
  ASSERT_TRUE(client.command("play", {{"speed", 20}, {"source", "guide"}})["ok"]);
  const Json played =
      client.event_where("state", [](const Json& s) { return !s["playback"].is_null() && !s["playback"]["playing"]; });
  EXPECT_TRUE(played["playback"]["blocked"].is_null()) << played["playback"];
  ASSERT_TRUE(client.command("close_guide")["ok"]);
  EXPECT_TRUE(client.state()["search"].is_null());
}

TEST_F(ServerSearch, PlansForATargetWithWhatIsFixed) {
  start_with(scenes::stack_in_tube(3));
  Client client(address());
  client.state();
  search(client, "plan", {{"targets", {kMiddle}}});
  EXPECT_EQ(state_where(client, "search")["guide"]["moves"].size(), 2u);
  for (const auto& [fixed, first] : {std::pair(kLow, kHigh), std::pair(kHigh, kLow)}) {
    search(client, "plan", {{"targets", {kMiddle}}, {"fixed", {kTube, fixed}}});
    const Json wanted = {first};
    const Json state = client.event_where("state", [&](const Json& s) {
      return !s["guide"].is_null() && s["guide"]["moves"][0]["components"] == wanted;
    });
    EXPECT_EQ(state["guide"]["moves"][1]["components"], Json{kMiddle});
  }
  EXPECT_FALSE(client.command("plan", {{"targets", {kLow}}, {"fixed", {kLow}}})["ok"]);
  EXPECT_FALSE(client.command("plan", {{"targets", {9}}})["ok"]);
}

TEST_F(ServerSearch, PlansWithWhatIsPreferred) {
  // A shelf in a slot of a wall, and a cup on it.
  constexpr std::uint32_t kShelf = 2, kCup = 3;
  start_with(scenes::assembly({scenes::component("a over", scenes::box({-20, -30, 2}, {0, 30, 40})),
                               scenes::component("b under", scenes::box({-20, -30, -40}, {0, 30, 0})),
                               scenes::component("c shelf", scenes::box({-4, -3, 0}, {10, 3, 2})),
                               scenes::component("d cup", scenes::box({0, -6, 2}, {9, 6, 22}))}));
  Client client(address());
  client.state();
  for (const auto& [preferred, first] : {std::pair("direction", kShelf), std::pair("support", kCup)}) {
    search(client, "plan", {{"fixed", {0, 1}}, {"prefer", {preferred}}});
    const Json wanted = {first};
    const Json state = client.event_where("state", [&](const Json& s) {
      return !s["guide"].is_null() && s["guide"]["moves"][0]["components"] == wanted;
    });
    EXPECT_EQ(state["guide"]["moves"].size(), 2u);
  }
  for (const Json& wrong : {Json("groups"), Json{"beauty"}, Json{"groups", "groups"}, Json{"groups=0"}, Json{1}})
    EXPECT_FALSE(client.command("plan", {{"prefer", wrong}})["ok"]) << wrong;
}

TEST_F(ServerSearch, SearchesAsLongAsAskedForAndSaysWhetherMoreMayHelp) {
  start_with(scenes::assembly(scenes::open_rings(6.1)));
  Client client(address());
  client.state();
  search(client, "plan", {{"effort", 0.0005}});
  const Json early = state_where(client, "search")["search"];
  EXPECT_EQ(early["effort"], 0.0005);
  EXPECT_TRUE(early["effort_spent"]);
  EXPECT_FALSE(early["complete"]);
  EXPECT_EQ(early["reasons"].size(), 1u);
  search(client, "plan", {{"effort", 4}});
  const Json late = client.event_where(
      "state", [](const Json& s) { return !s["search"].is_null() && s["search"]["effort"] == 4; })["search"];
  EXPECT_FALSE(late["effort_spent"]);
  EXPECT_TRUE(late["complete"]);
  for (const Json& wrong : {Json(0), Json(-1), Json(1000.5), Json("much"), Json{1}, Json(nullptr)})
    EXPECT_FALSE(client.command("plan", {{"effort", wrong}})["ok"]) << wrong;
}

TEST_F(ServerSearch, RemovesTheObstaclesAndThenTheTarget) {
  start_with(scenes::stack_in_tube(3));
  Client client(address());
  client.state();
  search(client, "find_path", {{"components", {kMiddle}}});
  const Json state = after_motion(client);
  ASSERT_EQ(state["moves"].size(), 2u);
  EXPECT_EQ(state["moves"][1]["label"], "take out box 1");
  EXPECT_TRUE(state["components"][kMiddle].contains("removed"));
  EXPECT_EQ(audited_recording().removed.size(), 2u);
  // The next search is for the remaining components.
  const std::uint32_t left = state["components"][kLow].contains("removed") ? kHigh : kLow;
  search(client, "find_path", {{"components", {left}}});
  EXPECT_TRUE(after_motion(client)["components"][left].contains("removed"));
  audited_recording();
  EXPECT_FALSE(client.command("find_path", {{"components", {kMiddle}}})["ok"]);  // it is out
  ASSERT_TRUE(client.command("undo")["ok"]);
  ASSERT_TRUE(client.command("undo")["ok"]);
  EXPECT_EQ(client.state()["components"][kMiddle], Json::object());
}

TEST_F(ServerSearch, TakesABodyOutAndThenApart) {
  start_with(scenes::framed_dovetail());
  Client client(address());
  client.state();
  search(client, "find_path", {{"components", {0, 1}}});
  const Json state = after_motion(client);
  ASSERT_GE(state["moves"].size(), 2u);
  EXPECT_EQ(state["moves"][0]["components"], (Json{0, 1}));
  EXPECT_TRUE(state["components"][0].contains("pose") && state["components"][1].contains("pose"));
  audited_recording();
}

TEST_F(ServerSearch, SaysWhyAComponentStaysUntilItMoves) {
  start_with(scenes::closed_shell());
  Client client(address());
  client.state();
  EXPECT_EQ(search(client, "why", {{"components", {1}}})["status"], "done");
  const Json state = state_where(client, "search");
  EXPECT_EQ(state["search"]["kind"], "why");
  const Json reason = state["search"]["reasons"][0];
  EXPECT_EQ(reason["component"], 1);
  ASSERT_EQ(reason["blockers"].size(), 1u);
  EXPECT_EQ(reason["blockers"][0]["component"], 0);
  EXPECT_TRUE(state["moves"].empty());
  const std::uint32_t grip = hold(client, 1);
  drag(client, grip, {}, {0, 0, 3}, 3);
  client.command("release");
  EXPECT_TRUE(client.state()["search"].is_null());
  EXPECT_FALSE(client.command("why", {{"components", {0, 1}}})["ok"]);
}

TEST_F(ServerSearch, SaysWhatBlocksIfNothingCanBeRemoved) {
  start_with(scenes::closed_shell());
  Client client(address());
  client.state();
  search(client, "find_path", {{"components", {1}}});
  const Json state = state_where(client, "search");
  EXPECT_FALSE(state["search"]["complete"]);
  EXPECT_EQ(state["search"]["reasons"][0]["blockers"][0]["component"], 0);
  EXPECT_TRUE(state["moves"].empty());
  EXPECT_TRUE(state["automatic"].is_null());
}

TEST_F(ServerSearch, CanBeCancelledAndAllowsDraggingMeanwhile) {
  start_with(scenes::stack_in_tube(60));
  Client client(address());
  client.state();
  const Json reply = client.command("plan");
  ASSERT_TRUE(reply["ok"]);
  EXPECT_FALSE(client.command("plan")["ok"]);  // one at a time
  const std::uint32_t grip = hold(client, 60);
  EXPECT_NEAR(drag(client, grip, {}, {0, 0, 30}, 30).pose.position.z, 30, 1e-9);
  ASSERT_TRUE(client.command("cancel", {{"job", reply["job"]}})["ok"]);
  const Json last =
      client.event_where("job", [&](const Json& j) { return j["job"] == reply["job"] && j["status"] != "running"; });
  EXPECT_EQ(last["status"], "cancelled");
  EXPECT_GT(last["seconds"], 0);
  client.command("release");
}

TEST_F(ServerSearch, KeepsTheStepsFoundUntilAPlanIsCancelled) {
  start_with(scenes::stack_in_tube(60));
  Client client(address());
  client.state();
  const Json reply = client.command("plan");
  const auto is_found = [](const Json& j) {
    return j["stage"].get<std::string>().find("steps found") != std::string::npos;
  };
  client.event_where("job", is_found);
  ASSERT_TRUE(client.command("cancel", {{"job", reply["job"]}})["ok"]);
  const Json state = state_where(client, "search");
  EXPECT_TRUE(state["search"]["cancelled"]);
  EXPECT_FALSE(state["search"]["complete"]);
  EXPECT_GE(state["search"]["steps"], 2);
  EXPECT_LT(state["search"]["steps"], 60);
  EXPECT_EQ(state["guide"]["moves"].size(), state["search"]["steps"]);
}

TEST_F(ServerSearch, NamesWhatHasToBeRemovedFirst) {
  start_with(scenes::stack_in_tube(4));
  Client client(address());
  client.state();
  search(client, "why", {{"components", {2}}});
  const Json chain = state_where(client, "search")["search"]["chain"];
  EXPECT_EQ(chain["before"], (Json{{1}})) << chain;
  EXPECT_NEAR(chain["direction"][2], -1, 1e-9);
}

TEST_F(ServerSearch, PlaysNoPathFoundBeforeSomethingMoved) {
  start_with(scenes::stack_in_tube(40));
  Client client(address());
  client.state();
  const Json reply = client.command("find_path", {{"components", {39}}});
  ASSERT_TRUE(reply["ok"]);
  const std::uint32_t grip = hold(client, 40);
  drag(client, grip, {}, {0, 0, 2}, 2);
  client.command("release");
  const Json warning = client.event("log");
  EXPECT_NE(warning["text"].get<std::string>().find("components were moved meanwhile"), std::string::npos) << warning;
  EXPECT_EQ(client.state()["moves"].size(), 1u);
}

}  // namespace
}  // namespace dismantle::server
