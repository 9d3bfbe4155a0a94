// SPDX-License-Identifier: Apache-2.0
// A page's use of a session, over a real socket.
#include "tests/server/server_scene.h"

namespace dismantle::server {
namespace {

using testing_client::Client;
using testing_client::get;
using testing_client::HttpReply;

class ServerSession : public ServerScene {
 protected:
  void SetUp() override { start_with_block_and_wall(); }
};

TEST_F(ServerSession, TellsWhatIsOpen) {
  Client client(address());
  const Json model = client.event("model");
  EXPECT_EQ(model["name"], "block.obj");
  EXPECT_EQ(model["product"], "block");
  EXPECT_EQ(model["components"][0]["name"], "block");
  EXPECT_EQ(model["components"][1]["triangles"], 12);
  const Json state = client.state();
  EXPECT_EQ(state["components"].size(), 2u);
  EXPECT_TRUE(state["hand"].is_null());
  const HttpReply glb = get(address(), "/api/model.glb?model=" + std::to_string(model["number"].get<int>()));
  EXPECT_EQ(glb.status, 200u);
  EXPECT_EQ(glb.body.substr(0, 4), "glTF");
  EXPECT_EQ(get(address(), "/api/model.glb?model=99").status, 404u);
}

TEST_F(ServerSession, DragsABlockIntoTheWallAndSaysWhatItTouches) {
  Client client(address());
  client.state();
  const std::uint32_t grip = hold(client, 0);
  const PoseMessage free = drag(client, grip, {}, {5, 0, 0}, 5);
  EXPECT_EQ(free.pose, (Pose{{5, 0, 0}, {}}));
  EXPECT_EQ(free.flags & kReached, kReached);
  EXPECT_TRUE(free.contacts.empty());
  EXPECT_GT(free.clearance, 0);
  client.send_binary(target_at(grip, 6, {30, 0, 0}));
  const PoseMessage stopped = client.pose_for_target(6);
  EXPECT_NEAR(stopped.pose.position.x, 10.5, 0.01);
  EXPECT_EQ(stopped.flags & kStopped, kStopped);
  ASSERT_FALSE(stopped.contacts.empty());
  EXPECT_EQ(stopped.contacts[0].moving, 0u);
  EXPECT_EQ(stopped.contacts[0].fixed, 1u);
  EXPECT_NEAR(stopped.contacts[0].normal.x, -1, 1e-3);
  EXPECT_EQ(stopped.state, client.state()["number"]);
}

TEST_F(ServerSession, RecordsADragThatPassesTheAudit) {
  Client client(address());
  client.state();
  const std::uint32_t grip = hold(client, 0);
  drag(client, grip, {}, {20, 5, 0}, 20);
  EXPECT_TRUE(client.command("release")["ok"]);
  const Json state = client.state();
  EXPECT_EQ(state["moves"].size(), 1u);
  EXPECT_EQ(state["undo"], "move block");
  const Path path = audited_recording();
  ASSERT_EQ(path.moves.size(), 1u);
  const Pose& end = path.moves[0].frames.back().pose;
  EXPECT_EQ(to_json(end), state["components"][0]["pose"]);  // bit for bit
}

TEST_F(ServerSession, AppliesTheLastTargetBeforeRelease) {
  Client client(address());
  client.state();
  const std::uint32_t grip = hold(client, 0);
  for (std::uint32_t i = 1; i <= 50; ++i) client.send_binary(target_at(grip, i, {-0.1 * i, 0, 0}));
  client.command("release");
  EXPECT_EQ(client.state()["components"][0]["pose"][0], -0.1 * 50);
}

TEST_F(ServerSession, GoesBackToTheStartOfADragInMidDrag) {
  Client client(address());
  client.state();
  const std::uint32_t grip = hold(client, 0);
  drag(client, grip, {}, {-5, 0, 0}, 5);
  EXPECT_TRUE(client.command("undo")["ok"]);
  Json state = client.state();
  EXPECT_TRUE(state["hand"].is_null());
  EXPECT_FALSE(state["components"][0].contains("pose"));
  client.send_binary(target_at(grip, 6, {-9, 0, 0}));  // of a released grip
  EXPECT_TRUE(client.command("redo")["ok"]);
  EXPECT_EQ(client.state()["components"][0]["pose"][0], -5.0);
  EXPECT_TRUE(client.command("undo")["ok"]);
  EXPECT_FALSE(client.command("undo")["ok"]);
  const std::uint32_t second = hold(client, 0);
  drag(client, second, {}, {-5, 0, 0}, 5);
  EXPECT_TRUE(client.command("cancel_drag")["ok"]);
  state = client.state();
  EXPECT_TRUE(state["undo"].is_null());
  EXPECT_FALSE(state["components"][0].contains("pose"));
}

TEST_F(ServerSession, FollowsA3dMouseAndStopsWhenItFallsSilent) {
  Client client(address());
  client.state();
  const std::uint32_t grip = hold(client, 0);
  client.send_binary(encode(RateMessage{grip, 1, {-100, 0, 0}, {}}));
  client.idle(std::chrono::milliseconds(600));
  client.command("release");
  const double x = client.state()["components"][0]["pose"][0];
  EXPECT_LT(x, -5);  // 100 mm/s for 150 ms
  EXPECT_GT(x, -20);
}

TEST_F(ServerSession, RefusesInvalidCommands) {
  Client client(address());
  client.state();
  for (const Json& components : {Json(Json::array()), Json{7}, Json{-1}, Json{"block"}, Json("block"), Json(nullptr)})
    EXPECT_FALSE(client.command("hold", {{"components", components}})["ok"]) << components;
  EXPECT_FALSE(client.command("set_response", {{"response", "bounce"}})["ok"]);
  EXPECT_FALSE(client.command("fly")["ok"]);
  EXPECT_FALSE(client.command("clearance")["ok"]);
  EXPECT_TRUE(client.command("check")["ok"]);
}

using ServerStreams = ServerScene;

TEST_F(ServerStreams, DragsByMethodStreamsAndOffersItsResponses) {
  ServerOptions options;
  options.model.drag_by_streams = true;
  options.model.device = DeviceChoice::Cpu;
  start_with_block_and_wall(std::move(options));
  Client client(address());
  const Json state = client.state();
  EXPECT_EQ(state["method"], "streams");
  EXPECT_EQ(state["response"], "touch");
  EXPECT_EQ(state["responses"], (Json{"touch", "stop"}));
  EXPECT_FALSE(client.command("set_response", {{"response", "slide"}})["ok"]);
  EXPECT_TRUE(client.command("set_response", {{"response", "stop"}})["ok"]);
  EXPECT_TRUE(client.command("set_response", {{"response", "touch"}})["ok"]);
  const PoseMessage last = drag(client, hold(client, 0), {0, 0, 0}, {15, 0, 0}, 15);
  EXPECT_NEAR(last.pose.position.x, 10.5, 0.02);
  EXPECT_FALSE(last.contacts.empty());
  EXPECT_EQ(client.command("metrics")["device"], "cpu");
  client.command("release");
  audited_recording();
}

TEST_F(ServerSession, HidesIsolatesAndRestores) {
  Client client(address());
  client.state();
  client.command("hide", {{"components", {0}}});
  EXPECT_TRUE(client.state()["components"][0].contains("hidden"));
  EXPECT_FALSE(client.command("hold", {{"components", {0}}})["ok"]);
  client.command("isolate", {{"components", {0}}});
  Json state = client.state();
  EXPECT_TRUE(state["isolated"]);
  EXPECT_FALSE(state["components"][0].contains("hidden"));
  EXPECT_TRUE(state["components"][1].contains("hidden"));
  client.command("restore");
  state = client.state();
  EXPECT_TRUE(state["components"][0].contains("hidden"));
  EXPECT_FALSE(state["components"][1].contains("hidden"));
}

TEST_F(ServerSession, OpensASampleAndTellsHowItGoes) {
  Client client(address());
  client.state();
  EXPECT_EQ(client.command("samples")["samples"].size(), 4u);
  EXPECT_FALSE(client.command("open", {{"sample", "spaceship"}})["ok"]);
  const Json reply = client.command("open", {{"sample", "microscope"}});
  ASSERT_TRUE(reply["ok"]) << reply;
  const Json done =
      client.event_where("job", [&](const Json& j) { return j["job"] == reply["job"] && j["status"] != "running"; });
  EXPECT_EQ(done["status"], "done") << done;
  const Json model = client.event_where("model", [](const Json& j) { return j["name"] == "microscope.step"; });
  EXPECT_GT(model["components"].size(), 20u);
}

TEST_F(ServerSession, TakesAComponentOutAndPutsItBack) {
  Client client(address());
  client.state();
  const Json directions = client.command("free_directions", {{"components", {0}}});
  ASSERT_TRUE(directions["ok"]) << directions;
  EXPECT_TRUE(directions["directions"][0]["free"]);
  const Json blocked = client.command("take_out", {{"components", {0}}, {"direction", {1, 0, 0}}});
  EXPECT_NE(blocked["error"].get<std::string>().find("'wall' is in the way"), std::string::npos) << blocked;
  ASSERT_TRUE(client.command("take_out", {{"components", {0}}, {"direction", {-1, 0, 0}}})["ok"]);
  EXPECT_EQ(client.event_where("state", [](const Json& s) { return !s["automatic"].is_null(); })["automatic"],
            "take_out");
  EXPECT_TRUE(client.pose().flags & kAutomatic);
  Json state = client.event_where("state", [](const Json& s) { return s["automatic"].is_null(); });
  EXPECT_TRUE(state["components"][0].contains("removed"));
  EXPECT_EQ(audited_recording().removed, std::vector<std::string>{"block"});
  ASSERT_TRUE(client.command("put_back", {{"components", {0}}})["ok"]);
  state = client.event_where("state", [](const Json& s) { return s["automatic"].is_null(); });
  EXPECT_EQ(state["components"][0], Json::object());
  audited_recording();
}

TEST_F(ServerSession, PlaysTheRecordingInBothDirectionsToTheSameBits) {
  Client client(address());
  client.state();
  const std::uint32_t grip = hold(client, 0);
  drag(client, grip, {}, {20, 12, 3}, 30);
  client.command("release");
  const Json there = client.state()["components"][0]["pose"];
  ASSERT_TRUE(client.command("play", {{"speed", -5}})["ok"]);
  const auto is_over = [](const Json& s) { return !s["playback"].is_null() && !s["playback"]["playing"]; };
  Json state = client.event_where("state", is_over);
  EXPECT_EQ(state["playback"]["time"], 0.0);
  EXPECT_EQ(state["components"][0], Json::object());  // assembled, bit for bit
  EXPECT_FALSE(client.command("hold", {{"components", {0}}})["ok"]);
  ASSERT_TRUE(client.command("play", {{"speed", 5}})["ok"]);
  client.event_where("state", [](const Json& s) { return !s["playback"].is_null() && s["playback"]["playing"]; });
  state = client.event_where("state", is_over);
  EXPECT_EQ(state["components"][0]["pose"], there);
  ASSERT_TRUE(client.command("seek", {{"time", 0.01}})["ok"]);
  ASSERT_TRUE(client.command("stop")["ok"]);
  state = client.state();
  EXPECT_TRUE(state["playback"].is_null());
  EXPECT_EQ(state["components"][0]["pose"], there);
  EXPECT_EQ(state["moves"].size(), 1u);
}

TEST_F(ServerSession, SavesTheRecordingAndFollowsItAsAGuide) {
  Client client(address());
  client.state();
  const std::uint32_t grip = hold(client, 0);
  drag(client, grip, {}, {-8, 0, 0}, 8);
  client.command("release");
  EXPECT_TRUE(client.command("save", {{"root", 0}, {"file", "mine.path.json"}})["ok"]);
  EXPECT_FALSE(client.command("save", {{"root", 0}, {"file", "mine.step"}})["ok"]);
  EXPECT_FALSE(client.command("save", {{"root", 0}, {"file", "../mine.path.json"}})["ok"]);
  EXPECT_FALSE(client.command("save", {{"root", 1}, {"file", "mine.path.json"}})["ok"]);
  EXPECT_EQ(get(address(), "/api/guide.json").status, 404u);
  client.command("reset");
  const Json opened = client.command("open_path", {{"root", 0}, {"file", "mine.path.json"}});
  ASSERT_TRUE(opened["ok"]) << opened;
  EXPECT_EQ(client.state()["guide"]["moves"].size(), 1u);
  EXPECT_EQ(get(address(), "/api/guide.json").status, 200u);
  ASSERT_TRUE(client.command("play", {{"speed", 10}, {"source", "guide"}})["ok"]);
  const Json state =
      client.event_where("state", [](const Json& s) { return !s["playback"].is_null() && !s["playback"]["playing"]; });
  EXPECT_EQ(state["components"][0]["pose"][0], -8.0);
  ASSERT_TRUE(client.command("close_guide")["ok"]);
  EXPECT_TRUE(client.state()["guide"].is_null());
}

TEST_F(ServerSession, KeepsAMotionByItselfFromCommandsThatWouldTearIt) {
  Client client(address());
  client.state();
  ASSERT_TRUE(client.command("take_out", {{"components", {0}}, {"direction", {0, 1, 0}}})["ok"]);
  client.pose();
  ASSERT_TRUE(client.command("undo")["ok"]);  // halts it, and undoes its motion
  EXPECT_EQ(client.state()["components"][0], Json::object());
  EXPECT_TRUE(client.state()["automatic"].is_null());
}

}  // namespace
}  // namespace dismantle::server
