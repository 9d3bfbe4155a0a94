// SPDX-License-Identifier: Apache-2.0
// The address space of the program is limited, so that an allocation somewhere fails.
#include "dismantle/audit/audit_path.h"
#include "dismantle/documents/path_file.h"
#include "dismantle/isolation/confinement.h"
#include "dismantle/loading/write_assembly.h"
#include "tests/faults/fault_scene.h"
#include "tests/faults/killed_server.h"
#include "tests/planner/plan_scenes.h"

#include <csignal>
#include <stdexcept>

namespace dismantle::faults {
namespace {

namespace fs = std::filesystem;
using server::Json;
using server::testing_client::Client;
using server::testing_client::get;
using server::testing_client::ServerAddress;

constexpr std::size_t kMegabyte = std::size_t{1} << 20;
/// Any of these works commands and the viewer do.
constexpr std::size_t kMuch = 2048 * kMegabyte;

SpawnOptions memory(std::size_t bytes) {
  SpawnOptions limits;
  limits.max_memory_bytes = bytes;
  return limits;
}

class LittleMemory : public FaultScene {
 protected:
  void SetUp() override {
    if (kUnderSanitizer) GTEST_SKIP() << "sanitizers reserve address space";
    FaultScene::SetUp();
  }
  /// The least memory in which the program itself can be loaded, in steps of two megabytes.
  std::size_t least_memory() const {
    std::size_t bytes = 2 * kMegabyte;
    while (run({"--version"}, memory(bytes)).exit_code != 0) bytes += 2 * kMegabyte;
    return bytes;
  }
};

TEST_F(LittleMemory, IsAnErrorOfACommandWhereverItStrikes) {
  const Result<Done> written = write_assembly(folder_ / "product.dasm", scenes::stations(400));
  ASSERT_TRUE(written.ok());
  folder_.put("lift.motion.json", R"({"format": "dismantle-motion", "version": 1, "response": "touch", "moves": [
      {"components": ["cover"], "targets": [
        {"t": 0.0, "position": [0, 0, 0], "rotation": [1, 0, 0, 0]},
        {"t": 1.0, "position": [0, 0, 30], "rotation": [1, 0, 0, 0]}]}]})");
  const std::vector<std::vector<std::string>> commands = {
      {"move", "product.dasm", "lift.motion.json", "-o", "out/a.path.json"},
      {"check", "product.dasm", "--html", "out/a.html"}};
  const std::size_t least = least_memory();
  for (const std::vector<std::string>& arguments : commands) {
    std::size_t failures = 0;
    for (std::size_t bytes = least; bytes < kMuch; bytes += (failures < 6 ? 3 : 20) * kMegabyte) {
      SCOPED_TRACE(arguments[0] + " in " + std::to_string(bytes / kMegabyte) + " MB");
      const CommandEnd end = run(arguments, memory(bytes));
      if (end.exit_code == 0) break;
      ++failures;
      expect_failure(end, "out of memory");
      EXPECT_EQ(outputs(), FolderContents{});
      if (HasFailure()) return;
    }
    EXPECT_GT(failures, 2u) << "the limit struck nowhere";
    EXPECT_EQ(outputs().size(), 1u);
    restore(folder_ / "out", {});
  }
}

/// How a viewer with little memory worked and ended.
struct ViewerEnd {
  bool has_started = false, has_model = false, has_ended = false;
  int exit_code = 0;
  std::string messages, lost;
  std::size_t poses = 0;
};

/// Waits for the assembly. @return why it is refused; empty if it is open
std::string refusal(const ServerAddress& address, Client& client) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(3);
  while (get(address, "/api/path.json").status != 200) {
    client.idle(std::chrono::milliseconds(100));
    if (std::chrono::steady_clock::now() < end) continue;
    return client.event_where("job", [](const Json& job) { return job["status"] == "failed"; })["error"];
  }
  return {};
}

/// Drags, then has everything done that takes memory.
ViewerEnd work_in(const KilledServer& server, std::size_t bytes, KillDice& dice) {
  ViewerEnd end;
  try {
    const auto viewer = server.start(memory(bytes));
    end.has_started = true;
    try {
      Client client(viewer->address());
      end.messages = refusal(viewer->address(), client);
      end.has_model = end.messages.empty();
      if (!end.has_model) return end;
      end.poses = drag_randomly(client, dice, 0.1).size();
      for (const char* what : {"page.html", "animation.glb", "path.json"})
        get(viewer->address(), "/api/export/" + std::string(what));
      end_of_job(client, client.command("open", {{"root", 0}, {"file", "stack.obj"}}));
    } catch (const std::runtime_error& error) {  // it has ended, or what was asked for failed
      end.lost = error.what();
    }
    const std::optional<int> code = viewer->program().wait_for(0.5);
    end.has_ended = code.has_value();
    end.exit_code = code.value_or(0);
    end.messages = viewer->messages();
  } catch (const std::runtime_error& error) {
    end.messages = error.what();
  }
  return end;
}

// Not run by default: where memory ends depends on the threads, and some places are not handled yet, in about one run
// of five. --gtest_also_run_disabled_tests
TEST_F(LittleMemory, DISABLED_EndsTheViewerByASentenceIfAtAllAndKeepsTheSession) {
  const KilledServer server(folder_ / "viewer");
  KillDice dice(8);
  std::size_t started = 0, failed = 0;
  for (std::size_t bytes = least_memory(); bytes < kMuch && started < 5; bytes += 80 * kMegabyte) {
    SCOPED_TRACE("in " + std::to_string(bytes / kMegabyte) + " MB");
    fs::remove_all(server.folder() / "state");
    const ViewerEnd end = work_in(server, bytes, dice);
    if (end.has_model && !end.has_ended && end.poses == 0) ADD_FAILURE() << "it neither works nor ends: " << end.lost;
    started += end.has_started ? 1 : 0;
    if (!end.has_model || end.has_ended) {
      ++failed;
      EXPECT_NE(end.messages.find("memory"), std::string::npos) << end.messages;
    }
    if (end.has_ended) {
      EXPECT_EQ(end.exit_code, 4) << end.messages;
    }
    if (end.poses == 0) continue;
    const auto viewer = server.start();
    Client client(viewer->address());
    const Json state = client.state();
    EXPECT_TRUE(state["resumed"].get<bool>() || state["resumable"].get<bool>());
    const Result<Path> path = parse_path(get(viewer->address(), "/api/path.json").body, "recording");
    ASSERT_TRUE(path.ok());
    EXPECT_TRUE(audit_path(server.assembly(), *path).holds());
  }
  EXPECT_GE(failed, 1u) << "the limit struck nowhere";
  EXPECT_GE(started, 1u);
}

}  // namespace
}  // namespace dismantle::faults
