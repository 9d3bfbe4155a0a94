// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/audit_path.h"
#include "tests/audit/depth_scenes.h"

#include <gtest/gtest.h>

#include <limits>

namespace dismantle {
namespace {

using audit_scenes::count;
using audit_scenes::messages;
using audit_scenes::move_through;
using depth_scenes::along;

constexpr double kTolerance = 0.01, kInfinity = std::numeric_limits<double>::infinity();
constexpr Vec3 kUp{0, 0, 1}, kDown{0, 0, -1};

/// A pin that is `depth` deep in a block, with its pair as the path lists it.
struct PinInBlock {
  Assembly assembly;
  Path path;

  explicit PinInBlock(double depth) {
    assembly = scenes::assembly({scenes::component("block", depth_scenes::block()),
                                 scenes::component("pin", scenes::box({1, 1, -depth}, {4, 4, 5 - depth}))});
    path = audit_scenes::path_of(assembly, kTolerance);
    path.version = kPathVersion;
  }

  PinInBlock& list(PathPairState state, double initial, double allowed) {
    path.pairs = {{"pin", "block", state, initial, allowed}};
    return *this;
  }
  PinInBlock& move(Vec3 direction, const std::vector<double>& distances) {
    path.moves.push_back(move_through({"pin"}, along(direction, distances)));
    return *this;
  }
  AuditReport audit() const { return audit_path(assembly, path); }
};

/// True if the file is inconsistent, and nothing else is wrong.
bool inconsistent(const AuditReport& report) {
  return report.violations.size() == 1 && count(report, AuditViolationKind::PathInconsistent) == 1;
}

TEST(PathPairs, AllowAnOverlapItsInitialDepthAndTheTolerance) {
  for (const double depth : {0.05, 0.5}) {
    PinInBlock scene(depth);
    scene.list(PathPairState::Overlapping, depth, depth + kTolerance);
    EXPECT_TRUE(PinInBlock(scene).move(kDown, {0, 0.95 * kTolerance}).audit().holds());
    EXPECT_FALSE(PinInBlock(scene).move(kDown, {0, 1.2 * kTolerance}).audit().holds());
    EXPECT_TRUE(PinInBlock(scene).move(kUp, {0, 3}).audit().holds());
    const AuditReport report = scene.audit();
    ASSERT_EQ(report.pairs.size(), 1u);
    EXPECT_EQ(report.pairs[0].state, PathPairState::Overlapping);
    EXPECT_NEAR(report.pairs[0].initial_depth, depth, 0.1 * kTolerance + 0.002 * depth);
  }
}

TEST(PathPairs, HonourAnAllowanceThatIsLessThanTheOverlapJustifies) {
  PinInBlock scene(0.5);
  scene.list(PathPairState::Overlapping, 0.5, 0.505);
  EXPECT_TRUE(PinInBlock(scene).move(kDown, {0, 0.003}).audit().holds());
  EXPECT_FALSE(PinInBlock(scene).move(kDown, {0, 0.009}).audit().holds());
  scene.list(PathPairState::Overlapping, 0.4, 0.41);
  EXPECT_TRUE(inconsistent(scene.audit())) << messages(scene.audit());
}

TEST(PathPairs, CannotLicenseThemselves) {
  PinInBlock scene(0.5);
  const double margin = 0.01 * 0.5;
  EXPECT_TRUE(
      PinInBlock(scene).list(PathPairState::Overlapping, 0.5 + 0.9 * margin, 0.51 + 0.9 * margin).audit().holds());
  for (const auto& [initial, allowed] : {std::pair{0.5, 0.6}, {0.6, 0.51}, {2.0, 2.01}, {0.52, 0.53}}) {
    const AuditReport report = PinInBlock(scene).list(PathPairState::Overlapping, initial, allowed).audit();
    EXPECT_TRUE(inconsistent(report)) << initial << " " << allowed << "\n" << messages(report);
  }
  // What the path allows beyond that is not allowed.
  const AuditReport deeper = PinInBlock(scene).list(PathPairState::Overlapping, 0.5, 2).move(kDown, {0, 1}).audit();
  EXPECT_EQ(count(deeper, AuditViolationKind::Depth), 1u);
  EXPECT_EQ(count(deeper, AuditViolationKind::PathInconsistent), 1u);
}

TEST(PathPairs, MayAllowOnePercentOfTheDepthMoreAndNoMoreThanThat) {
  for (const double depth : {0.5, 2.0}) {
    const auto audit_with = [&](double more) {
      const PinInBlock scene = PinInBlock(depth).list(PathPairState::Overlapping, depth, depth + kTolerance + more);
      return scene.audit();
    };
    EXPECT_TRUE(audit_with(0.009 * depth).holds()) << messages(audit_with(0.009 * depth));
    EXPECT_TRUE(inconsistent(audit_with(0.0185 * depth))) << depth;
  }
}

/// Sagittas are allowed where the two may turn in each other, and not for facets elsewhere.
TEST(PathPairs, MayAllowTheSagittasOfFacetsNearTheOtherComponentOnly) {
  const auto audit_with = [](const TriangleMesh& fixed, const TriangleMesh& moving, double depth, double allowed) {
    const Assembly a = scenes::assembly({scenes::component("fixed", fixed), scenes::component("moving", moving)});
    Path path = audit_scenes::path_of(a, kTolerance);
    path.version = kPathVersion;
    path.pairs = {{"fixed", "moving", PathPairState::Overlapping, depth, allowed}};
    return audit_path(a, path);
  };
  const TriangleMesh hole = depth_scenes::blind_hole(48, 5, 12, 15, 30),
                     peg = depth_scenes::prism(depth_scenes::circle(48, 5.02), 20, 45);
  const double sagitta = 5 * (1 - std::cos(std::numbers::pi / 48));
  const AuditReport turning = audit_with(hole, peg, 0.02, 0.02 + kTolerance + 1.8 * sagitta);
  EXPECT_TRUE(turning.holds()) << messages(turning);
  EXPECT_TRUE(turning.pairs.at(0).turns);
  EXPECT_TRUE(inconsistent(audit_with(hole, peg, 0.02, 0.02 + kTolerance + 2.5 * sagitta)));

  // A block with a cylinder beyond each of its sides in turn, whose facets have a sagitta of about 0.1 mm.
  const Vec3 sides[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const Vec3 side : sides) {
    TriangleMesh fixed = depth_scenes::block();
    const TriangleMesh far = scenes::moved(depth_scenes::prism(depth_scenes::circle(16, 5), -5, 5), {80 * side, {}});
    const auto first = static_cast<std::uint32_t>(fixed.vertices.size());
    fixed.vertices.insert(fixed.vertices.end(), far.vertices.begin(), far.vertices.end());
    for (const Face& f : far.faces) fixed.faces.push_back({{f.v[0] + first, f.v[1] + first, f.v[2] + first}});
    const TriangleMesh pin = scenes::box({1, 1, -0.5}, {4, 4, 4.5});
    EXPECT_TRUE(audit_with(fixed, pin, 0.5, 0.51).holds());
    EXPECT_TRUE(inconsistent(audit_with(fixed, pin, 0.5, 0.56))) << side.x << " " << side.y << " " << side.z;
    EXPECT_TRUE(inconsistent(audit_with(pin, fixed, 0.5, 0.56))) << side.x << " " << side.y << " " << side.z;
  }
}

TEST(PathPairs, CannotLicenseWhatTouchesOrIsApart) {
  for (const double depth : {0.0, 0.005, -1.0}) {
    const AuditReport report = PinInBlock(depth).list(PathPairState::Overlapping, 0.1, 0.11).audit();
    EXPECT_TRUE(inconsistent(report)) << depth << messages(report);
    EXPECT_TRUE(inconsistent(PinInBlock(depth).list(PathPairState::Overlapping, 0, 0.11).audit()));
  }
}

/// The depth of the path may be an upper bound slightly above the tolerance, though the depth itself is not.
TEST(PathPairs, MayListAPairThatIsAsDeepAsTheTolerance) {
  const PinInBlock scene = PinInBlock(0.96 * kTolerance).list(PathPairState::Overlapping, 0.0105, 0.0205);
  EXPECT_TRUE(scene.audit().holds()) << messages(scene.audit());
  EXPECT_TRUE(inconsistent(PinInBlock(0.8 * kTolerance).list(PathPairState::Overlapping, 0.0105, 0.0205).audit()));
}

TEST(PathPairs, MustListAnOverlapExceptInVersionOne) {
  PinInBlock scene(0.5);
  EXPECT_TRUE(inconsistent(scene.audit())) << messages(scene.audit());
  scene.move(kDown, {0, 0.95 * kTolerance});
  EXPECT_TRUE(inconsistent(scene.audit()));
  scene.path.version = 1;
  EXPECT_TRUE(scene.audit().holds()) << messages(scene.audit());
  scene.move(kDown, {0.95 * kTolerance, 0.1});
  EXPECT_EQ(count(scene.audit(), AuditViolationKind::Depth), 1u);
}

TEST(PathPairs, AreHonouredWhereDeclared) {
  PinInBlock scene(0.5);
  scene.list(PathPairState::Declared, 0.5, 2);
  const AuditReport report = PinInBlock(scene).move(kDown, {0, 1.49}).audit();
  EXPECT_TRUE(report.holds()) << messages(report);
  EXPECT_EQ(report.count(PathPairState::Declared), 1u);
  EXPECT_EQ(report.pairs[0].allowed, 2);
  EXPECT_FALSE(PinInBlock(scene).move(kDown, {0, 1.52}).audit().holds());
  EXPECT_TRUE(inconsistent(scene.list(PathPairState::Declared, 0.5, 0.3).audit()));
}

TEST(PathPairs, AreListedAsUncheckedWhereFree) {
  PinInBlock scene(0.5);
  scene.list(PathPairState::Free, 0.5, kInfinity);
  const AuditReport report = PinInBlock(scene).move(kDown, {0, 8}).audit();
  EXPECT_TRUE(report.holds()) << messages(report);
  ASSERT_EQ(report.count(PathPairState::Free), 1u);
  EXPECT_FALSE(report.pairs[0].parted);
  EXPECT_EQ(report.pairs[0].allowed, kInfinity);
}

TEST(PathPairs, HaveTheToleranceOnceTheyHaveBeenApart) {
  for (const PathPairState state : {PathPairState::Overlapping, PathPairState::Declared, PathPairState::Free}) {
    PinInBlock scene(0.5);
    scene.list(state, 0.5, state == PathPairState::Free ? kInfinity : 0.51);
    scene.move(kUp, {0, 0.4, 0.505}).move(kUp, {0.505, 0.495});
    const AuditReport shallow = scene.audit();
    EXPECT_TRUE(shallow.holds()) << messages(shallow);
    EXPECT_TRUE(shallow.pairs[0].parted);
    const AuditReport deep = scene.move(kUp, {0.495, 0.4}).audit();
    ASSERT_EQ(deep.violations.size(), 1u) << messages(deep);
    EXPECT_EQ(deep.violations[0].allowed, kTolerance);
    EXPECT_NE(deep.violations[0].message.find("as they have been apart"), std::string::npos);
    // Not before.
    EXPECT_TRUE(PinInBlock(0.5)
                    .list(state, 0.5, state == PathPairState::Free ? kInfinity : 0.51)
                    .move(kUp, {0, 0.4, 0.5005, 0.2})
                    .audit()
                    .holds());
  }
}

TEST(PathPairs, HaveBeenApartFromATenthOfTheToleranceOn) {
  for (const auto& [gap, parted] : {std::pair{0.08, false}, {0.12, true}, {0.19, true}}) {
    const double out = 0.5 + gap * kTolerance;
    PinInBlock scene(0.5);
    scene.list(PathPairState::Overlapping, 0.5, 0.51).move(kUp, {0, out}).move(kUp, {out, 0.4});
    const AuditReport report = scene.audit();
    EXPECT_EQ(report.pairs.at(0).parted, parted) << gap;
    EXPECT_EQ(report.holds(), !parted) << gap << messages(report);
  }
}

}  // namespace
}  // namespace dismantle
