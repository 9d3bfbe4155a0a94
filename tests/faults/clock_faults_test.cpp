// SPDX-License-Identifier: Apache-2.0
// The time of day jumps by decades while the program runs, or between two runs.
#include "dismantle/isolation/confinement.h"
#include "tests/faults/fault_scene.h"
#include "tests/faults/killed_server.h"

#include <atomic>
#include <csignal>
#include <fstream>
#include <map>
#include <set>
#include <thread>

namespace dismantle::faults {
namespace {

namespace fs = std::filesystem;
using server::Json;
using server::testing_client::Client;

constexpr long kDecade = 315'360'000;  // [s]

class ClockJump : public FaultScene {
 protected:
  void SetUp() override {
    if (kUnderSanitizer) GTEST_SKIP() << "a sanitizer must be the first library";
    FaultScene::SetUp();
    set(0);
  }
  /// Sets the clock [s] from the true time.
  void set(long shift) const {
    std::ofstream(folder_ / "clock.new") << shift;
    fs::rename(folder_ / "clock.new", folder_ / "clock");
  }
  SpawnOptions shifted() const {
    SpawnOptions options;
    options.environment = {"LD_PRELOAD=" DISMANTLE_SHIFTED_CLOCK, "DISMANTLE_CLOCK=" + (folder_ / "clock").string()};
    return options;
  }
};

TEST_F(ClockJump, ReachesTheProgram) {
  const std::vector<std::string> arguments = {"export", "stack.dasm", "stack.path.json", "-o", "out/instructions.html"};
  std::set<std::string> pages;
  for (const long shift : {0L, 3 * kDecade}) {
    set(shift);
    ASSERT_EQ(run(arguments, shifted()).exit_code, 0);
    pages.insert(outputs()["instructions.html"]);
  }
  EXPECT_EQ(pages.size(), 2u) << "their dates are three decades apart";
}

TEST_F(ClockJump, ChangesNothingInASession) {
  const KilledServer server(folder_ / "viewer");
  KillDice dice(7);
  std::string recording;
  {
    const auto viewer = server.start(shifted());
    Client client(viewer->address());
    client.state();
    for (const long shift : {kDecade, -kDecade, 0L}) {
      set(shift);
      EXPECT_GT(drag_randomly(client, dice, 0.1).size(), 3u);
      EXPECT_TRUE(client.command("release")["ok"]);
    }
    for (const Json& move : client.state()["moves"]) {
      EXPECT_GE(move["duration"], 0);
      EXPECT_LT(move["duration"], 10);
    }
    set(2 * kDecade);
    const Json end = end_of_job(client, client.command("plan"));
    EXPECT_EQ(end["status"], "done");
    EXPECT_LT(end["seconds"], 60);
    EXPECT_GE(end["seconds"], 0);
    recording = server::testing_client::get(viewer->address(), "/api/path.json").body;
    viewer->end(SIGKILL);
  }
  set(-2 * kDecade);
  const auto viewer = server.start(shifted());
  Client client(viewer->address());
  EXPECT_TRUE(client.state()["resumed"]);
  EXPECT_EQ(server::testing_client::get(viewer->address(), "/api/path.json").body, recording);
}

TEST_F(ClockJump, EndsNoSearchThatHasATimeLimit) {
  const std::vector<std::string> arguments = {"plan", "stack.dasm", "--time-limit", "600", "-o", "out/a.path.json"};
  ASSERT_EQ(run(arguments).exit_code, 0);
  const FolderContents undisturbed = outputs();
  std::atomic<bool> has_ended{false};
  std::thread jumps([&] {
    for (long k = 1; !has_ended; ++k) {
      set(k % 2 == 0 ? kDecade : -kDecade);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  });
  const CommandEnd end = run(arguments, shifted());
  has_ended = true;
  jumps.join();
  EXPECT_EQ(end.exit_code, 0) << end.err;
  EXPECT_EQ(end.out.find("ended early"), std::string::npos) << end.out;
  EXPECT_EQ(outputs(), undisturbed);
}

TEST_F(ClockJump, LosesNeitherTheCacheNorWhatABatchHasDone) {
  const std::vector<std::string> import = fault_commands(folder_.path(), "import")[0].arguments;
  set(kDecade);
  ASSERT_EQ(run(import, shifted()).exit_code, 0);
  const FolderContents cache = contents_of(folder_ / "cache"), result = outputs();
  EXPECT_FALSE(cache.empty());
  for (const long shift : {-kDecade, 2 * kDecade}) {
    set(shift);
    ASSERT_EQ(run(import, shifted()).exit_code, 0);
    EXPECT_EQ(outputs(), result);
    EXPECT_EQ(contents_of(folder_ / "cache"), cache);
  }
  restore(folder_ / "out", {});
  const std::vector<std::string> batch = fault_commands(folder_.path(), "batch")[0].arguments;
  ASSERT_EQ(run(batch, shifted()).exit_code, 0);
  set(-kDecade);
  const CommandEnd again = run(batch, shifted());
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(again.out.find("[2/2]"), std::string::npos) << again.out;
  EXPECT_NE(again.out.find("(done before)"), again.out.rfind("(done before)")) << again.out;
}

/// The only uses of the time of day, and how often each file names it. A new one needs a look at what a jump does to
/// it; durations are measured by the steady clock.
const std::map<std::string, int> kUsesOfTheTimeOfDay = {
    {"apps/batch/batch_items.cpp", 1},                         // compares file times with each other only
    {"apps/batch/batch_result.cpp", 1},                        // makes a name unique
    {"src/dismantle/files/file_cache.cpp", 3},                 // what was used last; abandoned files after a day
    {"src/dismantle/instructions/instructions_file.cpp", 1}};  // the date of a document

TEST(TimeOfDay, IsUsedByTheseFilesOnly) {
  const std::vector<std::string> names = {"system_clock",   "file_time_type::clock", "time(nullptr)",   "time(NULL)",
                                          "CLOCK_REALTIME", "gettimeofday",          "last_write_time("};
  std::map<std::string, int> found;
  const fs::path root = DISMANTLE_SOURCE_DIR;
  for (const char* folder : {"src", "apps"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const fs::path extension = entry.path().extension();
      if (extension != ".cpp" && extension != ".h" && extension != ".cu" && extension != ".cuh") continue;
      const std::string file = entry.path().lexically_relative(root).generic_string();
      if (file == "src/dismantle/isolation/confinement.cpp") continue;  // the names of system calls
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);)
        found[file] += std::any_of(names.begin(), names.end(),
                                   [&line](const std::string& name) { return line.find(name) != std::string::npos; });
      if (found[file] == 0) found.erase(file);
    }
  EXPECT_EQ(found, kUsesOfTheTimeOfDay);
}

}  // namespace
}  // namespace dismantle::faults
