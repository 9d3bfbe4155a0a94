// SPDX-License-Identifier: Apache-2.0
// What a page does with a session, over a real socket.
#include "dismantle/audit/audit_path.h"
#include "dismantle/io/load_assembly.h"
#include "dismantle/io/path_file.h"
#include "tests/server/server_scene.h"

namespace dismantle::server {
namespace {

using testing_client::Client;
using testing_client::get;
using testing_client::HttpReply;

class ServerSession : public ServerScene {
 protected:
  void SetUp() override { start_with_block_and_wall(); }

  /// Takes a component in hand. @return the grip
  static std::uint32_t hold(Client& client, std::uint32_t component) {
    const Json answer = client.command("hold", {{"components", {component}}});
    EXPECT_TRUE(answer["ok"]) << answer;
    return answer.value("grip", 0u);
  }
  /// Drags along a straight line in steps, each answered before the next is asked for.
  static PoseMessage drag(Client& client, std::uint32_t grip, const Vec3& from, const Vec3& to, std::uint32_t steps) {
    PoseMessage last;
    for (std::uint32_t i = 1; i <= steps; ++i) {
      client.send_binary(target_at(grip, i, from + (static_cast<double>(i) / steps) * (to - from)));
      last = client.pose_answering(i);
    }
    return last;
  }
  /// The recording, which must pass the audit.
  Path audited_recording() const {
    const HttpReply reply = get(door(), "/api/path.json");
    const Result<Path> path = parse_path(reply.body, "recording");
    EXPECT_TRUE(path.ok()) << reply.body;
    const Result<Assembly> assembly = load_assembly(folder() / "block.obj");
    const AuditReport report = audit_path(*assembly, *path);
    EXPECT_TRUE(report.holds());
    return *path;
  }
};

TEST_F(ServerSession, TellsWhatIsOpen) {
  Client client(door());
  const Json model = client.event("model");
  EXPECT_EQ(model["name"], "block.obj");
  EXPECT_EQ(model["components"][0]["name"], "block");
  EXPECT_EQ(model["components"][1]["triangles"], 12);
  const Json state = client.state();
  EXPECT_EQ(state["components"].size(), 2u);
  EXPECT_TRUE(state["hand"].is_null());
  const HttpReply glb = get(door(), "/api/model.glb?model=" + std::to_string(model["number"].get<int>()));
  EXPECT_EQ(glb.status, 200u);
  EXPECT_EQ(glb.body.substr(0, 4), "glTF");
  EXPECT_EQ(get(door(), "/api/model.glb?model=99").status, 404u);
}

TEST_F(ServerSession, DragsABlockIntoTheWallAndSaysWhatItTouches) {
  Client client(door());
  client.state();
  const std::uint32_t grip = hold(client, 0);
  const PoseMessage free = drag(client, grip, {}, {5, 0, 0}, 5);
  EXPECT_EQ(free.pose, (Pose{{5, 0, 0}, {}}));
  EXPECT_EQ(free.flags & kReached, kReached);
  EXPECT_TRUE(free.contacts.empty());
  EXPECT_GT(free.clearance, 0);
  client.send_binary(target_at(grip, 6, {30, 0, 0}));
  const PoseMessage stopped = client.pose_answering(6);
  EXPECT_NEAR(stopped.pose.position.x, 10.5, 0.01);
  EXPECT_EQ(stopped.flags & kStopped, kStopped);
  ASSERT_FALSE(stopped.contacts.empty());
  EXPECT_EQ(stopped.contacts[0].moving, 0u);
  EXPECT_EQ(stopped.contacts[0].fixed, 1u);
  EXPECT_NEAR(stopped.contacts[0].normal.x, -1, 1e-3);
  EXPECT_EQ(stopped.state, client.state()["number"]);
}

TEST_F(ServerSession, RecordsADragThatPassesTheAudit) {
  Client client(door());
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

TEST_F(ServerSession, CountsTheLastTargetBeforeTheHandLetsGo) {
  Client client(door());
  client.state();
  const std::uint32_t grip = hold(client, 0);
  for (std::uint32_t i = 1; i <= 50; ++i) client.send_binary(target_at(grip, i, {-0.1 * i, 0, 0}));
  client.command("release");
  EXPECT_EQ(client.state()["components"][0]["pose"][0], -0.1 * 50);
}

TEST_F(ServerSession, GoesBackToTheStartOfADragInMidDrag) {
  Client client(door());
  client.state();
  const std::uint32_t grip = hold(client, 0);
  drag(client, grip, {}, {-5, 0, 0}, 5);
  EXPECT_TRUE(client.command("undo")["ok"]);
  Json state = client.state();
  EXPECT_TRUE(state["hand"].is_null());
  EXPECT_FALSE(state["components"][0].contains("pose"));
  client.send_binary(target_at(grip, 6, {-9, 0, 0}));  // of a grip that is over
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
  Client client(door());
  client.state();
  const std::uint32_t grip = hold(client, 0);
  client.send_binary(encode(RateMessage{grip, 1, {-100, 0, 0}, {}}));
  client.idle(std::chrono::milliseconds(600));
  client.command("release");
  const double x = client.state()["components"][0]["pose"][0];
  EXPECT_LT(x, -5);  // 100 mm/s for 150 ms
  EXPECT_GT(x, -20);
}

TEST_F(ServerSession, RefusesWhatMakesNoSense) {
  Client client(door());
  client.state();
  for (const Json& components : {Json(Json::array()), Json{7}, Json{-1}, Json{"block"}, Json("block"), Json(nullptr)})
    EXPECT_FALSE(client.command("hold", {{"components", components}})["ok"]) << components;
  EXPECT_FALSE(client.command("set_response", {{"response", "bounce"}})["ok"]);
  EXPECT_FALSE(client.command("fly")["ok"]);
  EXPECT_FALSE(client.command("clearance")["ok"]);
  EXPECT_TRUE(client.command("check")["ok"]);
}

TEST_F(ServerSession, HidesIsolatesAndRestores) {
  Client client(door());
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
  Client client(door());
  client.state();
  EXPECT_EQ(client.command("samples")["samples"].size(), 4u);
  EXPECT_FALSE(client.command("open", {{"sample", "spaceship"}})["ok"]);
  const Json answer = client.command("open", {{"sample", "microscope"}});
  ASSERT_TRUE(answer["ok"]) << answer;
  const Json done = client.event_where("job", [&](const Json& j) { return j["status"] != "running"; });
  EXPECT_EQ(done["status"], "done") << done;
  const Json model = client.event_where("model", [](const Json& j) { return j["name"] == "microscope.step"; });
  EXPECT_GT(model["components"].size(), 20u);
}

}  // namespace
}  // namespace dismantle::server
