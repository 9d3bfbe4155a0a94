// SPDX-License-Identifier: Apache-2.0
#include "tests/support/disassembly_cases.h"

#include "dismantle/audit/audit_path.h"
#include "dismantle/geometry/adjacency.h"
#include "dismantle/planner/plan_path.h"
#include "tests/planner/plan_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

using scenes::CaseKind;
using scenes::DisassemblyCase;

/// Expects that exactly the removable parts are removed, along paths that pass the audit.
void expect_right(CaseKind kind, const DisassemblyCase& made, double scale) {
  SCOPED_TRACE(testing::Message() << name_of(kind) << " at scale " << scale);
  const scenes::PlanScene scene = scenes::plan_scene(made.assembly, 0.01 * scale);
  PlanOptions options;
  options.slide_effort = scenes::kSlideEffort;
  options.sample_effort = 0;
  for (std::uint32_t c = 0; c < made.fixed; ++c) options.fixed.emplace_back(c);
  const Plan plan = plan_disassembly(scene.assembly, scene.pairs, options);
  EXPECT_EQ(plan.complete(), scenes::comes_apart(kind));
  EXPECT_EQ(plan.steps.size(), scenes::comes_apart(kind) ? made.assembly.components.size() - made.fixed : 0);
  // Their long paths are audited in the tests of their searches.
  if (kind == CaseKind::Screw || kind == CaseKind::Bayonet) return;
  const AuditReport report = audit_path(scene.assembly, plan_path(scene.assembly, scene.pairs, plan), {});
  EXPECT_TRUE(report.holds()) << (report.violations.empty() ? "" : report.violations[0].message);
}

TEST(DisassemblyCases, AreClosedSolids) {
  std::mt19937_64 random(2);
  for (const CaseKind kind : scenes::kCaseKinds) {
    const DisassemblyCase made = scenes::disassembly_case(kind, scenes::random_shape(random));
    for (const Assembly& assembly : {made.assembly, scenes::refined(made.assembly, random)})
      for (const Component& c : assembly.components) {
        const EdgeFaults faults = edge_faults(*c.mesh);
        EXPECT_EQ(faults.boundary + faults.misoriented, 0u) << name_of(kind) << ' ' << c.name;
      }
  }
}

class DisassemblyCaseOf : public testing::TestWithParam<CaseKind> {};

TEST_P(DisassemblyCaseOf, ComesApartOrDoesNotInAnyOrientationSizeAndTessellation) {
  const CaseKind kind = GetParam();
  std::mt19937_64 random(1);
  scenes::CaseShape shape = scenes::random_shape(random);
  shape.sides = 16;
  const DisassemblyCase made = scenes::disassembly_case(kind, shape);
  const double scale = std::array{0.01, 1.0, 1000.0}[static_cast<std::size_t>(kind) % 3];
  const Pose pose = scenes::random_pose(random, 50, 3);
  expect_right(kind, {scenes::placed(scenes::refined(made.assembly, random), pose, scale), made.fixed}, scale);
}

TEST(DisassemblyCases, EveryPinComesOutOfItsSlot) {
  // A push that ends just beyond a configuration on its path must add its end as a configuration, too.
  std::mt19937_64 random(1);
  for (int shape = 0; shape < 60; ++shape) {
    const DisassemblyCase made = scenes::disassembly_case(CaseKind::LSlot, scenes::random_shape(random));
    const scenes::PlanScene scene =
        scenes::plan_scene(scenes::placed(made.assembly, scenes::random_pose(random, 50, 3)));
    PlanOptions options;
    options.slide_effort = scenes::kSlideEffort;
    options.sample_effort = 0;
    options.fixed = {ComponentId(0)};
    EXPECT_TRUE(plan_disassembly(scene.assembly, scene.pairs, options).complete()) << shape;
  }
}

INSTANTIATE_TEST_SUITE_P(DisassemblyCases, DisassemblyCaseOf, testing::ValuesIn(scenes::kCaseKinds),
                         [](const testing::TestParamInfo<CaseKind>& tested) {
                           std::string name(name_of(tested.param));
                           std::erase_if(name, [](char c) { return c == ' ' || c == '-'; });
                           return name;
                         });

}  // namespace
}  // namespace dismantle
