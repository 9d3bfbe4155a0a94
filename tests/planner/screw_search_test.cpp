// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/screw_search.h"

#include "dismantle/audit/audit_path.h"
#include "dismantle/planner/plan_path.h"
#include "tests/planner/plan_scenes.h"
#include "tests/support/disassembly_cases.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

scenes::PlanScene bolt_in_nut(std::uint32_t sides) {
  return scenes::plan_scene(scenes::assembly(scenes::short_screw(0.05, sides)));
}

TEST(ScrewSearch, ScrewsABoltOutOfItsNut) {
  const scenes::PlanScene scene = bolt_in_nut(20);
  const Plan plan = plan_disassembly(scene.assembly, scene.pairs, {});
  ASSERT_EQ(plan.steps.size(), 1u);
  EXPECT_EQ(plan.steps[0].tier, PlanTier::Helical);
  EXPECT_GT(std::abs(plan.steps[0].exit.z), 0.999);
  const AuditReport report = audit_path(scene.assembly, plan_path(scene.assembly, scene.pairs, plan), {});
  EXPECT_TRUE(report.holds()) << (report.violations.empty() ? "" : report.violations[0].message);
}

TEST(ScrewSearch, KnowsTheThreadFromTheContacts) {
  const scenes::PlanScene scene = bolt_in_nut(48);
  CertificateEngine engine(scene.assembly, scene.pairs);
  const ComponentId bolt(1);
  engine.grab({&bolt, 1});
  const auto threads = touched_threads(scene.assembly, engine, 10, scene.pairs.tolerance);
  ASSERT_EQ(threads.size(), 1u);
  EXPECT_EQ(threads[0].neighbour, ComponentId(0));
  EXPECT_NEAR(threads[0].thread.lead, 1.25, 0.15);  // the flanks guide it
  EXPECT_NEAR(std::abs(threads[0].thread.direction.z), 1, 1e-3);
}

TEST(ScrewSearch, SeesNoThreadInAPlainBore) {
  const scenes::SlideScene peg = scenes::peg_in_hole(32, 0.02);
  const scenes::PlanScene scene = scenes::plan_scene(peg.assembly);
  CertificateEngine engine(scene.assembly, scene.pairs);
  engine.grab({&peg.moving, 1});
  EXPECT_TRUE(touched_threads(scene.assembly, engine, 15, scene.pairs.tolerance).empty());
}

}  // namespace
}  // namespace dismantle
