// SPDX-License-Identifier: Apache-2.0
// The program as a separate process: killed during a drag, and stopped by a signal.
#include "dismantle/session/journal_records.h"
#include "dismantle/session/session_path.h"
#include "tests/server/server_scene.h"
#include "tests/server/viewer_process.h"

#include <csignal>
#include <fstream>
#include <thread>

namespace dismantle::server {
namespace {

namespace fs = std::filesystem;
using testing_client::Client;
using testing_client::ViewerProcess;

class ServerCrash : public ServerScene {
 protected:
  void SetUp() override { write_block_and_wall(); }
  ViewerProcess start_process() const { return ViewerProcess(root() / "block.obj", folder_.path()); }
};

TEST_F(ServerCrash, ResumesAfterItWasKilledDuringADrag) {
  Json before;
  {
    ViewerProcess viewer = start_process();
    Client client(viewer.address());
    client.state();
    drag(client, hold(client, 1), {}, {0, 3, 0}, 3);
    client.command("release");
    drag(client, hold(client, 0), {}, {15, 7, 0}, 40);  // into the wall and along it, without release
    client.send_text(R"({"id": 90, "command": "check"})");
    client.reply(90);
    before = Json::parse(testing_client::get(viewer.address(), "/api/path.json").body);
    EXPECT_EQ(viewer.end(SIGKILL), 128 + SIGKILL);
  }
  ViewerProcess viewer = start_process();
  Client client(viewer.address());
  const Json state = client.state();
  EXPECT_TRUE(state["resumed"]);
  EXPECT_TRUE(state["hand"].is_null());
  EXPECT_EQ(state["moves"].size(), 2u);
  // Everything that was acknowledged is restored, bit for bit.
  const Json after = Json::parse(testing_client::get(viewer.address(), "/api/path.json").body);
  EXPECT_EQ(after, before);
  EXPECT_TRUE(client.command("undo")["ok"]);
  EXPECT_EQ(client.state()["components"][0], Json::object());
  EXPECT_TRUE(client.command("undo")["ok"]);
  EXPECT_FALSE(client.command("undo")["ok"]);
}

TEST_F(ServerCrash, OffersToContinueASessionThatEndedInOrder) {
  {
    ViewerProcess viewer = start_process();
    Client client(viewer.address());
    client.state();
    drag(client, hold(client, 0), {}, {-5, 0, 0}, 5);
    client.command("release");
    EXPECT_EQ(viewer.end(SIGTERM), 0);
    client.wait_for_end();
    EXPECT_EQ(client.close_code(), 1001u);
  }
  for (int run = 0; run < 2; ++run) {  // a run without changes does not lose it
    ViewerProcess viewer = start_process();
    Client client(viewer.address());
    const Json state = client.state();
    EXPECT_FALSE(state["resumed"]);
    EXPECT_TRUE(state["resumable"]);
    EXPECT_EQ(state["components"][0], Json::object());
    if (run == 1) {
      EXPECT_TRUE(client.command("resume")["ok"]);
      EXPECT_EQ(client.state()["components"][0]["pose"][0], -5.0);
      EXPECT_FALSE(client.command("resume")["ok"]);
    }
    EXPECT_EQ(viewer.end(SIGINT), 0);
  }
}

TEST_F(ServerCrash, KeepsTheSessionsOfTwoViewersApart) {
  ViewerProcess one = start_process();
  Client first(one.address());
  first.state();  // so that the journal is its own
  ViewerProcess two = start_process();
  Client second(two.address());
  second.state();
  drag(first, hold(first, 0), {}, {-5, 0, 0}, 5);
  drag(second, hold(second, 0), {}, {0, 5, 0}, 5);
  one.end(SIGKILL);
  two.end(SIGKILL);
  ViewerProcess again = start_process();
  Client client(again.address());
  EXPECT_EQ(client.state()["components"][0]["pose"][0], -5.0);
}

/// Appends records to the only journal.
void append_to_journal(const fs::path& state, const std::string& records) {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(state))
    if (entry.path().extension() == ".journal")
      std::ofstream(entry.path(), std::ios::binary | std::ios::app) << records;
}

TEST_F(ServerCrash, SaysWhatItDoesNotRestore) {
  SessionEntry broken{"move block", {ComponentId(0)}, {{0, {{-5, 0, 0}, {}}}}, {false}, {}};
  SessionEntry deep = broken;
  broken.frames[0].pose.rotation = {2, 0, 0, 0};
  deep.frames.push_back({1, {{12, 0, 0}, {}}});  // into the wall
  const auto records = [](const SessionEntry& entry) {
    return begin_record(entry) + (entry.frames.size() > 1 ? frames_record({&entry.frames[1], 1}) : "") +
           end_record(entry);
  };
  for (const auto& [entry, why] :
       {std::pair(broken, "a rotation is not of unit length"),
        std::pair(deep, "'block' is 1.5 mm deep in 'wall', which is more than is allowed")}) {
    {
      ViewerProcess viewer = start_process();
      Client client(viewer.address());
      client.state();
      drag(client, hold(client, 0), {}, {-5, 0, 0}, 5);
      client.command("release");
      viewer.end(SIGKILL);
    }
    append_to_journal(folder_ / "state", records(entry));
    for (const bool is_told : {true, false}) {  // the journal is whole from then on
      ViewerProcess viewer = start_process();
      Client client(viewer.address());
      const Json state = client.event_where("state", [](const Json& s) { return s["resumed"]; });
      EXPECT_EQ(state["components"][0]["pose"][0], -5.0);
      EXPECT_EQ(state["moves"].size(), 1u);
      EXPECT_TRUE(state["redo"].is_null());
      if (is_told) {
        const std::string text = client.event("log")["text"];
        EXPECT_NE(text.find("restored only up to its last valid state, with 1 move ("), std::string::npos) << text;
        EXPECT_NE(text.find(why), std::string::npos) << text;
      }
      viewer.end(SIGKILL);
    }
    fs::remove_all(folder_ / "state");
  }
}

TEST_F(ServerCrash, RemovesTheUploadsOfAViewerThatWasKilled) {
  fs::path left;
  {
    ViewerProcess viewer = start_process();
    Client client(viewer.address());
    client.state();
    const std::string head = "POST /api/open?name=a.obj HTTP/1.1\r\nHost: " + viewer.address().host() +
                             "\r\nAuthorization: Bearer " + viewer.address().token +
                             "\r\nX-Client: " + testing_client::kClientKey + "\r\nContent-Length: 1000\r\n\r\nv 0";
    testing_client::RawConnection upload(viewer.address());
    upload.send(head);
    EXPECT_EQ(upload.receive(), "");
    viewer.end(SIGKILL);
    left = *fs::directory_iterator(viewer.temporary_folder());
    EXPECT_TRUE(fs::exists(left / "1/a.obj"));
  }
  ViewerProcess viewer = start_process();
  EXPECT_FALSE(fs::exists(left));
}

TEST_F(ServerCrash, DoesNotSpinWhenItHasNoMoreDescriptors) {
  testing_client::SpawnOptions limits;
  limits.max_descriptors = 64;
  ViewerProcess viewer(root() / "block.obj", folder_.path(), limits);
  Client client(viewer.address());
  client.state();
  std::vector<std::unique_ptr<testing_client::RawConnection>> idle;
  for (int i = 0; i < 80; ++i) idle.push_back(std::make_unique<testing_client::RawConnection>(viewer.address()));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const double before = viewer.processor_seconds();
  std::this_thread::sleep_for(std::chrono::seconds(1));
  EXPECT_LT(viewer.processor_seconds() - before, 0.3);
  EXPECT_TRUE(client.command("check")["ok"]) << "who is connected is not concerned";
  int refused = 0;
  for (const auto& connection : idle) {
    connection->receive(std::chrono::milliseconds(1));
    refused += connection->is_closed();
  }
  EXPECT_GE(refused, 20);
  EXPECT_LT(refused, 80);
  const std::string messages = viewer.messages();
  EXPECT_EQ(messages.find("connections are refused for now"), messages.rfind("connections are refused for now"));
  EXPECT_NE(messages.find("connections are refused for now"), std::string::npos) << messages;
  idle.clear();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_EQ(testing_client::request(viewer.address(), "GET", "/").status, 200u);
}

TEST_F(ServerCrash, OpensAPathFileWithTheAssemblyBesideIt) {
  const Result<Assembly> assembly = load_assembly(root() / "block.obj");
  Path path = empty_path(*assembly, PairStates{0.01, {}});
  path.moves = {{"pull the block", {"block"}, {{0, {}}, {1, {{-5, 0, 0}, {}}}}}};
  ASSERT_TRUE(write_path(root() / "pull.path.json", path).ok());
  ViewerProcess viewer(root() / "pull.path.json", folder_.path());
  Client client(viewer.address());
  const Json state = client.event_where("state", [](const Json& s) { return !s["guide"].is_null(); });
  EXPECT_EQ(state["guide"]["name"], "pull.path.json");
  EXPECT_EQ(state["guide"]["moves"][0]["label"], "pull the block");
}

}  // namespace
}  // namespace dismantle::server
