// SPDX-License-Identifier: Apache-2.0
// The program as a separate process: killed during a drag, and stopped by a signal.
#include "dismantle/session/session_path.h"
#include "tests/server/server_scene.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace dismantle::server {
namespace {

using testing_client::Client;
using testing_client::ServerAddress;

/// `dismantle view` on block.obj.
class ViewerProcess {
 public:
  ViewerProcess(const std::filesystem::path& assembly, const std::filesystem::path& state) {
    int ends[2] = {-1, -1};
    if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    std::string program = DISMANTLE_PROGRAM, view = "view", file = assembly.string(), browser = "--no-browser",
                quiet = "--quiet", place = "XDG_STATE_HOME=" + state.string();
    char* arguments[] = {program.data(), view.data(), file.data(), browser.data(), quiet.data(), nullptr};
    char* environment[] = {place.data(), nullptr};
    const int status = posix_spawn(&process_, program.c_str(), &actions, nullptr, arguments, environment);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    if (status != 0) throw std::runtime_error("the program cannot be started");
    std::string url;
    for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';) url += c;
    close(ends[0]);
    const std::size_t colon = url.find(':', 7), mark = url.find("#token=");
    if (mark == std::string::npos) throw std::runtime_error("it printed no URL but: " + url);
    address_ = {static_cast<std::uint16_t>(std::stoi(url.substr(colon + 1))), url.substr(mark + 7)};
  }
  ~ViewerProcess() {
    if (process_ > 0) end(SIGKILL);
  }
  ViewerProcess(const ViewerProcess&) = delete;
  ViewerProcess& operator=(const ViewerProcess&) = delete;

  const ServerAddress& address() const { return address_; }
  /// Sends a signal and waits. @return the exit code; 128 + the signal if that ended it
  int end(int signal) {
    kill(process_, signal);
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

 private:
  pid_t process_ = 0;
  ServerAddress address_;
};

class ServerCrash : public ServerScene {
 protected:
  void SetUp() override { write_block_and_wall(); }
  ViewerProcess start_process() const { return ViewerProcess(root() / "block.obj", folder_ / "state"); }
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
  ViewerProcess one = start_process(), two = start_process();
  Client first(one.address()), second(two.address());
  first.state();
  second.state();
  drag(first, hold(first, 0), {}, {-5, 0, 0}, 5);
  drag(second, hold(second, 0), {}, {0, 5, 0}, 5);
  one.end(SIGKILL);
  two.end(SIGKILL);
  ViewerProcess again = start_process();
  Client client(again.address());
  EXPECT_EQ(client.state()["components"][0]["pose"][0], -5.0);
}

TEST_F(ServerCrash, OpensAPathFileWithTheAssemblyBesideIt) {
  const Result<Assembly> assembly = load_assembly(root() / "block.obj");
  Path path = empty_path(*assembly, PairStates{0.01, {}});
  path.moves = {{"pull the block", {"block"}, {{0, {}}, {1, {{-5, 0, 0}, {}}}}}};
  ASSERT_TRUE(write_path(root() / "pull.path.json", path).ok());
  ViewerProcess viewer(root() / "pull.path.json", folder_ / "state");
  Client client(viewer.address());
  const Json state = client.event_where("state", [](const Json& s) { return !s["guide"].is_null(); });
  EXPECT_EQ(state["guide"]["name"], "pull.path.json");
  EXPECT_EQ(state["guide"]["moves"][0]["label"], "pull the block");
}

}  // namespace
}  // namespace dismantle::server
