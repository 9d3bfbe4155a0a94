// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/audit_path.h"
#include "dismantle/audit/solid/ghost_point.h"
#include "dismantle/audit/solid/solid_body.h"

#include "tests/audit/depth_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

using audit::SolidBody;
using depth_scenes::along;
using depth_scenes::audit_pair;
using depth_scenes::inside_out;
using depth_scenes::messages;
using depth_scenes::sheet;
using depth_scenes::steps;

constexpr Vec3 kDown{0, 0, -1};

bool crosses(const AuditReport& audit) {
  return audit_scenes::count(audit, AuditViolationKind::Crossing) == 1 &&
         audit_scenes::count(audit, AuditViolationKind::Depth) == 0;
}

TEST(SheetCrossing, RejectsASheetThatPassesThroughASheet) {
  for (const TriangleMesh& moving : {sheet(1, 1), inside_out(sheet(1, 1))}) {
    const AuditReport through = audit_pair(sheet(3, 0), moving, along(kDown, steps(0.5, 6)));
    EXPECT_TRUE(crosses(through)) << messages(through);
    EXPECT_EQ(through.violations[0].frame, 2u);
    EXPECT_TRUE(audit_pair(sheet(3, 0), moving, along(kDown, {0, 1.009})).holds());
    EXPECT_FALSE(audit_pair(sheet(3, 0), moving, along(kDown, {0, 1.012})).holds());
    EXPECT_TRUE(crosses(audit_pair(sheet(3, 0), moving, along(kDown, {0, 300}))));
  }
}

TEST(SheetCrossing, RejectsAFoilThatPassesThroughAFoilThinnerThanTheTolerance) {
  const TriangleMesh lower = scenes::box({-3, -3, -0.004}, {3, 3, 0}), upper = scenes::box({-1, -1, 1}, {1, 1, 1.004});
  EXPECT_TRUE(crosses(audit_pair(lower, upper, along(kDown, {0, 1.1}))));
  EXPECT_TRUE(crosses(audit_pair(lower, upper, along(kDown, {0, 10}))));
  EXPECT_TRUE(audit_pair(lower, upper, along(kDown, {0, 1.009})).holds());
}

TEST(SheetCrossing, RejectsAHairThroughASheet) {
  const TriangleMesh hair = scenes::box({0.101, 0.201, 1}, {0.104, 0.204, 4});
  const AuditReport moving = audit_pair(sheet(3, 0), hair, along(kDown, {0, 2}));
  const AuditReport fixed = audit_pair(hair, sheet(3, 0), along({0, 0, 1}, {0, 2}));
  ASSERT_TRUE(crosses(moving) && crosses(fixed));
  // It is a point of the hair that went through.
  EXPECT_FALSE(moving.violations[0].point_of_a);
  EXPECT_TRUE(fixed.violations[0].point_of_a);
}

TEST(SheetCrossing, AcceptsSheetsThatSlideAlongEachOtherAndPartAgain) {
  std::vector<Pose> poses = along(kDown, {0, 0.998});
  for (int k = 1; k <= 40; ++k) poses.push_back({{0.05 * k, 0.02 * k, -0.998}, quat_about({0, 0, 1}, 0.02 * k)});
  poses.push_back({{2, 0.8, 0}, quat_about({0, 0, 1}, 0.8)});
  const AuditReport audit = audit_pair(sheet(3, 0), sheet(1, 1), poses);
  EXPECT_TRUE(audit.holds()) << messages(audit);
  poses.back().position.z = -2;
  EXPECT_TRUE(crosses(audit_pair(sheet(3, 0), sheet(1, 1), poses)));
}

TEST(SheetCrossing, AcceptsASheetThatPassesBesideTheEdgeOfAnother) {
  EXPECT_TRUE(audit_pair(sheet(3, 0), scenes::moved(sheet(1, 1), {{4.001, 0, 0}, {}}), along(kDown, {0, 3})).holds());
  // It goes through the edge by less than the tolerance: what follows its corners can go round the edge.
  EXPECT_TRUE(audit_pair(sheet(3, 0), scenes::moved(sheet(1, 1), {{3.996, 0, 0}, {}}), along(kDown, {0, 3})).holds());
  EXPECT_FALSE(audit_pair(sheet(3, 0), scenes::moved(sheet(1, 1), {{3.98, 0, 0}, {}}), along(kDown, {0, 3})).holds());
  EXPECT_FALSE(audit_pair(sheet(3, 0), scenes::moved(sheet(1, 1), {{3.9, 0, 0}, {}}), along(kDown, {0, 3})).holds());
}

/// The edge in any direction: no point gets round it that is further from it than the tolerance and the slack.
TEST(SheetCrossing, RejectsASheetThatGoesThroughAnEdgeByMoreThanTheTolerance) {
  for (const Vec3 axis : {Vec3{0, 1, 0}, Vec3{0.6, 0.8, 0}, Vec3{0.48, 0.6, 0.64}})
    for (const double angle : {0.4, 0.8, 1.2}) {
      const Pose turn{{}, quat_about(axis, angle)};
      const Vec3 down = mat3_from_quat(turn.rotation) * kDown;
      const auto audit_by = [&](double overlap) {
        return audit_pair(scenes::moved(sheet(3, 0), turn),
                          scenes::moved(scenes::moved(sheet(1, 1), {{4 - overlap, 0, 0}, {}}), turn),
                          along(down, {0, 3}));
      };
      EXPECT_TRUE(audit_by(0.004).holds()) << angle;
      for (const double overlap : {0.0115, 0.013, 0.016}) EXPECT_TRUE(crosses(audit_by(overlap))) << angle << overlap;
    }
}

TEST(SheetCrossing, LetsSheetsThatTouchAtTheStartLeaveToEitherSideButNotReturn) {
  for (const double side : {1.0, -1.0}) {
    EXPECT_TRUE(audit_pair(sheet(3, 0), sheet(1, 0.004), along({0, 0, side}, {0, 1})).holds());
    EXPECT_TRUE(crosses(audit_pair(sheet(3, 0), sheet(1, 0.004), along({0, 0, side}, {0, 1, -1}))));
  }
}

TEST(SheetCrossing, RemembersSidesFromMoveToMove) {
  const Assembly a =
      scenes::assembly({scenes::component("fixed", sheet(3, 0)), scenes::component("moving", sheet(1, 1))});
  Path path = audit_scenes::path_of(a, 0.01);
  for (const auto& way : {std::pair{0.0, 0.995}, std::pair{0.995, 1.004}, std::pair{1.004, 1.008}})
    path.moves.push_back(audit_scenes::move_through({"moving"}, along(kDown, {way.first, way.second})));
  EXPECT_TRUE(audit_path(a, path).holds());
  path.moves.push_back(audit_scenes::move_through({"moving"}, along(kDown, {1.008, 1.02})));
  const AuditReport audit = audit_path(a, path);
  ASSERT_TRUE(crosses(audit)) << messages(audit);
  EXPECT_EQ(audit.violations[0].move, 3u);
}

/// A tip comes within the tolerance of a sheet in one move, its box and its sphere no nearer, and goes on in the next.
TEST(SheetCrossing, RemembersTheSideOfATipThatHasOnlyComeWithinTheTolerance) {
  TriangleMesh spindle = depth_scenes::ball(8, 2, 2, {});
  for (Vec3& p : spindle.vertices) p = {0.1 * p.x + 0.31, 0.1 * p.y + 0.17, p.z + 3};
  const Assembly a = scenes::assembly({scenes::component("fixed", sheet(3, 0)), scenes::component("moving", spindle)});
  Path path = audit_scenes::path_of(a, 0.01);
  path.moves = {audit_scenes::move_through({"moving"}, along(kDown, {0, 0.995})),
                audit_scenes::move_through({"moving"}, along(kDown, {0.995, 1.004}))};
  EXPECT_TRUE(audit_path(a, path).holds());
  path.moves[1] = audit_scenes::move_through({"moving"}, along(kDown, {0.995, 1.05}));
  const AuditReport audit = audit_path(a, path);
  ASSERT_TRUE(crosses(audit)) << messages(audit);
  EXPECT_EQ(audit.violations[0].move, 1u);
}

TEST(GhostPoint, SlidesAlongFacesAndIntoCornersAndNeverCrosses) {
  const SolidBody body(scenes::component("box", scenes::box({-1, -1, -1}, {1, 1, 1})));
  audit::GhostPoint ghost(body.surface(), 1e-4, {0.2, 0.1, 2});
  ghost.approach({0.3, 0.4, 0.5});
  EXPECT_LT(length(ghost.position() - Vec3{0.3, 0.4, 1.0001}), 1e-9);
  EXPECT_FALSE(ghost.shift({0, 0, -0.5}));
  EXPECT_TRUE(ghost.shift({0.1, -0.2, 0}));
  audit::GhostPoint inner(body.surface(), 1e-4, {0, 0, 0});
  inner.approach({3, 2, 5});
  EXPECT_LT(length(inner.position() - Vec3{0.9999, 0.9999, 0.9999}), 1e-9);
}

TEST(GhostPoint, StopsAtTheFirstOfSeveralFaces) {
  TriangleMesh shelves;
  for (const double z : {0.0, 1.0, -1.0, 0.5}) {
    const TriangleMesh shelf = sheet(1, z);
    const auto first = static_cast<std::uint32_t>(shelves.vertices.size());
    shelves.vertices.insert(shelves.vertices.end(), shelf.vertices.begin(), shelf.vertices.end());
    for (const Face& f : shelf.faces) shelves.faces.push_back({{f.v[0] + first, f.v[1] + first, f.v[2] + first}});
  }
  const SolidBody body(scenes::component("shelves", shelves));
  for (const double side : {1.0, -1.0}) {
    audit::GhostPoint ghost(body.surface(), 1e-4, {0.2, 0.3, 3 * side});
    ghost.approach({0.2, 0.3, -3 * side});
    EXPECT_NEAR(ghost.position().z, side * 1.0001, 1e-9);
  }
}

}  // namespace
}  // namespace dismantle
