// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/screw_search.h"

#include "dismantle/audit/audit_path.h"
#include "dismantle/planner/plan_path.h"
#include "dismantle/planner/search/component_axes.h"
#include "dismantle/planner/search/curved_steps.h"
#include "tests/planner/plan_scenes.h"
#include "tests/support/disassembly_cases.h"
#include "tests/support/faulty_meshes.h"

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

TEST(ScrewSearch, TurnsNoPlateThatIsHeldByThreeScrews) {
  const std::vector<Component> screw = scenes::short_screw(0.05, 24);
  TriangleMesh plate;
  std::vector<Component> components{{}};
  for (int k = 0; k < 3; ++k) {
    const Pose at{{60.0 * k, 0, 0}, {}};
    plate = scenes::joined(std::move(plate), scenes::moved(*screw[0].mesh, at));
    components.push_back(scenes::component("bolt " + std::to_string(k), scenes::moved(*screw[1].mesh, at)));
  }
  components[0] = scenes::component("plate", std::move(plate));
  const scenes::PlanScene scene = scenes::plan_scene(scenes::assembly(std::move(components)));
  std::vector<ShapeFeatures> features;
  for (const Component& c : scene.assembly.components) features.push_back(shape_features(assembled_mesh(c)));
  const RigidGroups groups(4);
  MotionValidator validator(scene.assembly, scene.pairs, {}, groups, 1e4, [] { return true; });
  ComponentAxes axes({scene.assembly, features, scene.pairs.tolerance}, validator);
  const ComponentId plate_id(0);
  const std::vector<NeighbourThread> threads = axes.threads_of(plate_id);
  ASSERT_EQ(threads.size(), 3u);
  ComponentSet body = ComponentSet::all(4);
  for (const NeighbourThread& known : threads) EXPECT_FALSE(axes.may_turn(plate_id, known.thread, body));
  for (std::uint32_t k = 1; k < 4; ++k)
    for (const NeighbourThread& known : axes.threads_of(ComponentId(k)))
      EXPECT_TRUE(axes.may_turn(ComponentId(k), known.thread, body));
  body.erase(std::vector<ComponentId>{ComponentId(1), ComponentId(2)});
  EXPECT_TRUE(axes.may_turn(plate_id, threads[2].thread, body));
}

TEST(ScrewSearch, DoesNotTurnWhatNoThreadHolds) {
  // A bolt between a floor and a lid, in a nut with the same thread that is as wide or far wider. Where the floor and
  // the lid are far away and one with the nut, the two do not part straight, but move by more than the thread lets
  // them.
  struct Case {
    bool wider, one_with_nut;
  };
  for (const auto [wider, one_with_nut] : {Case{false, false}, {true, false}, {false, true}, {true, true}}) {
    SCOPED_TRACE(testing::Message() << wider << one_with_nut);
    std::vector<Component> components = scenes::short_screw(0.05, 20);
    if (wider) components[0] = scenes::short_screw(1.2, 20)[0];
    const Aabb bolt = bounds(*components[1].mesh);
    const double gap = one_with_nut ? 4 : 0.2;
    for (const double z : {bolt.lower.z - gap - 1, bolt.upper.z + gap})
      components.push_back(scenes::component("plate", scenes::box({-9, -9, z}, {9, 9, z + 1})));
    if (one_with_nut) {
      components[0] = scenes::component(
          "nut", scenes::joined(scenes::joined(*components[0].mesh, *components[2].mesh), *components[3].mesh));
      components.resize(2);
    }
    const scenes::PlanScene scene = scenes::plan_scene(scenes::assembly(std::move(components)));
    std::vector<ShapeFeatures> features;
    for (const Component& c : scene.assembly.components) features.push_back(shape_features(assembled_mesh(c)));
    const std::size_t count = scene.assembly.components.size();
    const RigidGroups groups(count);
    const KeepGoing always = [] { return true; };
    MotionValidator validator(scene.assembly, scene.pairs, {}, groups, 1e4, always);
    BlockingTable table(validator.engine(), features, groups, always);
    const PlannedAssembly planned{scene.assembly, features, scene.pairs.tolerance};
    const ComponentSet all = ComponentSet::all(count);
    ComponentSet staying = all;
    staying.erase(ComponentId(1));
    const DirectionChoice choice(planned, table, validator.engine(), staying, {}, always);
    CurvedSteps curved(planned, {groups, features, validator, table, choice, always}, 0, 0);
    ASSERT_FALSE(ComponentAxes(planned, validator).threads_of(ComponentId(1)).empty());
    EXPECT_FALSE(curved.find_screwed(all, staying, CurvedSteps::Groups::Single, nullptr));
    EXPECT_EQ(validator.effort() > 0, !wider);
  }
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
