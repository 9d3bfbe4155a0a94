// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/plan_path.h"

#include "dismantle/audit/audit_path.h"
#include "tests/planner/plan_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

void expect_audited(const Assembly& assembly, const std::string& what) {
  const scenes::PlanScene scene = scenes::plan_scene(assembly);
  const Plan plan = plan_disassembly(scene.assembly, scene.pairs, {});
  const Path path = plan_path(scene.assembly, scene.pairs, plan);
  EXPECT_EQ(path.moves.size(), plan.steps.size());
  const AuditReport report = audit_path(scene.assembly, path, {});
  EXPECT_TRUE(report.holds()) << what << ": " << (report.violations.empty() ? "" : report.violations[0].message);
}

TEST(PlanPath, PassesTheAudit) {
  expect_audited(scenes::stack_in_tube(6), "stack");
  expect_audited(scenes::covered_pot(), "pot");
  expect_audited(scenes::peg_in_hole(32, 0.02).assembly, "peg");
  expect_audited(scenes::press_fit_pin(32, 0.03).assembly, "pin");
  expect_audited(scenes::dovetail(0).assembly, "dovetail");
}

TEST(PlanPath, PutsBodiesAsideWithRoomForWhatIsTakenOutOfThem) {
  // The links leave the plate as one subassembly: they cannot be separated.
  std::vector<Component> components = scenes::chain_links();
  components.push_back(scenes::component("plate", scenes::box({-40, -40, -20}, {40, 40, -8})));
  components.push_back(scenes::component("cube", scenes::box({20, 20, -8}, {24, 24, -4})));
  expect_audited(scenes::assembly(std::move(components)), "chain");
  expect_audited(scenes::framed_dovetail(), "framed dovetail");
}

TEST(PlanPath, EndsOutsideTheAssemblyAndApart) {
  const scenes::PlanScene scene = scenes::plan_scene(scenes::stack_in_tube(5));
  const Path path = plan_path(scene.assembly, scene.pairs, plan_disassembly(scene.assembly, scene.pairs, {}));
  EXPECT_EQ(path.removed.size(), 5u);
}

}  // namespace
}  // namespace dismantle
