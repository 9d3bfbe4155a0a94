// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/audit_path.h"
#include "tests/audit/depth_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

using audit_scenes::move_through;
using depth_scenes::along;

constexpr double kTolerance = 0.01;

/// A pin 0.5 mm deep in a block, and a plate that lies on the block.
Assembly scene() {
  return scenes::assembly({scenes::component("block", depth_scenes::block()),
                           scenes::component("pin", scenes::box({1, 1, -0.5}, {4, 4, 5})),
                           scenes::component("plate", scenes::box({-4, -4, 0}, {0, 0, 1}))});
}

Path path_of(const Assembly& assembly, const std::string& moving, Vec3 direction, double distance,
             double tolerance = kTolerance) {
  Path path = audit_scenes::path_of(assembly, tolerance);
  path.moves.push_back(move_through({moving}, along(direction, {0, distance})));
  return path;
}

/// The reports are the same, apart from the time.
void expect_equal(const AuditReport& got, const AuditReport& wanted) {
  EXPECT_EQ(got.violations, wanted.violations);
  EXPECT_EQ(got.pairs, wanted.pairs);
  EXPECT_EQ(got.slack, wanted.slack);
  EXPECT_EQ(got.sheets, wanted.sheets);
  EXPECT_EQ(got.pieces, wanted.pieces);
  EXPECT_EQ(got.complete, wanted.complete);
}

TEST(PathAuditor, GivesOfManyPathsWhatAuditPathGivesOfEach) {
  const Assembly assembly = scene();
  const PathAuditor auditor(assembly);
  std::vector<Path> paths = {path_of(assembly, "pin", {0, 0, 1}, 6), path_of(assembly, "plate", {0, 0, -1}, 0.5),
                             path_of(assembly, "plate", {0, 0, -1}, 0.5, 1), path_of(assembly, "pin", {0, 0, -1}, 2)};
  paths.push_back(paths.back());
  paths.back().version = kPathVersion;
  paths.back().pairs = {{"block", "pin", PathPairState::Free, 0, 0}};
  std::size_t held = 0, violated = 0;
  for (int pass = 0; pass < 2; ++pass)
    for (const Path& path : paths) {
      const AuditReport report = auditor.audit(path);
      expect_equal(report, audit_path(assembly, path));
      ++(report.holds() ? held : violated);
    }
  EXPECT_GE(held, 2u);
  EXPECT_GE(violated, 2u);
}

TEST(PathAuditor, DoesNotKeepWhatACancelledAuditBegan) {
  const Assembly assembly = scene();
  const PathAuditor auditor(assembly);
  const Path path = path_of(assembly, "pin", {0, 0, 1}, 6);
  AuditOptions cancelled;
  cancelled.progress = [](std::string_view, double) { return false; };
  EXPECT_FALSE(auditor.audit(path, cancelled).complete);
  expect_equal(auditor.audit(path), audit_path(assembly, path));
}

TEST(PathAuditor, AuditsFromSeveralThreads) {
  const Assembly assembly = scene();
  const PathAuditor auditor(assembly);
  std::vector<AuditReport> reports(16);
  Executor(ExecutorKind::Threads, 4).for_each_heavy(reports.size(), [&](std::size_t i) {
    reports[i] = auditor.audit(path_of(assembly, i % 2 == 0 ? "pin" : "plate", {0, 0, 1}, 1 + 0.1 * double(i)));
  });
  for (std::size_t i = 0; i < reports.size(); ++i)
    expect_equal(reports[i],
                 audit_path(assembly, path_of(assembly, i % 2 == 0 ? "pin" : "plate", {0, 0, 1}, 1 + 0.1 * double(i))));
}

}  // namespace
}  // namespace dismantle
