// SPDX-License-Identifier: Apache-2.0
// The program killed a few times at random moments. kill_at_random does it hundreds of times.
#include "tests/faults/kills.h"

#include "tests/faults/killed_server.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

namespace dismantle::faults {
namespace {

void expect_nothing_lost(const std::string& kind) {
  const ScratchFolder folder;
  const KillRow row = kill_at_random(kind, 3, 20261126, folder.path());
  EXPECT_EQ(row.kills, 3);
  EXPECT_EQ(row.violations, std::vector<std::string>{});
  EXPECT_LE(row.longest_loss, kMaxLoss);
  EXPECT_EQ(row.names_left, std::set<std::string>{});
}

TEST(Killed, LosesNothingWhileItImports) {
  expect_nothing_lost("import");
}

TEST(Killed, LosesNothingWhileItPlans) {
  expect_nothing_lost("plan");
}

TEST(Killed, LosesNothingWhileItExports) {
  expect_nothing_lost("export");
}

TEST(Killed, LosesNothingInABatch) {
  expect_nothing_lost("batch");
}

TEST(Killed, LosesNothingOfADrag) {
  expect_nothing_lost("drag");
}

TEST(Killed, LosesNothingWhileTheViewerSearchesOrOpens) {
  expect_nothing_lost("search");
}

TEST(LossOf, IsTheAgeOfTheOldestPoseThatIsMissing) {
  const std::chrono::steady_clock::time_point start;
  const auto at = [start](int ms) { return start + std::chrono::milliseconds(ms); };
  const std::vector<AcknowledgedPose> poses = {{at(0), {}}, {at(100), {{1, 0, 0}, {}}}, {at(300), {{2, 0, 0}, {}}}};
  Path path;
  EXPECT_NEAR(loss_of(poses, path, at(400)), 0.3, 1e-9);
  path.moves = {{"move", {"box"}, {{0, {}}, {0.1, {{1, 0, 0}, {}}}}}};
  EXPECT_NEAR(loss_of(poses, path, at(400)), 0.1, 1e-9);
  path.moves[0].frames.push_back({0.3, {{2, 0, 0}, {}}});
  EXPECT_EQ(loss_of(poses, path, at(400)), 0);
}

}  // namespace
}  // namespace dismantle::faults
