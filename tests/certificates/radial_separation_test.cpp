// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/front/radial_separation.h"

#include "dismantle/narrowphase/distance_triangle_triangle.h"
#include "dismantle/narrowphase/penetration_triangle_triangle.h"
#include "tests/support/pair_motions.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

struct Body {
  TriangleMesh mesh;
  ObbTree tree;
  std::unique_ptr<RevolutionSurface> revolution;
  explicit Body(TriangleMesh m) : mesh(std::move(m)) {
    tree = obb_tree_build(mesh.vertices, mesh.faces, Executor());
    revolution = std::make_unique<RevolutionSurface>(
        mesh.vertices, mesh.faces, tree.nodes, revolution_axes(mesh.vertices, mesh.faces), std::vector<ThreadAxis>{});
  }
};

/// The distance of two triangles, or minus the translation that separates them.
double true_gap(const Triangle& a, const Triangle& b) {
  const double distance = distance_triangle_triangle(a, b).distance;
  return distance > 0 ? distance : -penetration_triangle_triangle(a, b).depth;
}

Triangle at(const Pose& pose, const Triangle& t) {
  const RigidTransform r = transform_from_pose(pose);
  return {{r * t[0], r * t[1], r * t[2]}};
}

PairMotion motion_of(const Body& moving, const Body& fixed, const Pose& start, const Pose& end) {
  return scenes::pair_motion(moving.tree, fixed.tree, start, end);
}

/// The minimum gap of the triangles under each pair of nodes, at some times of the true screw.
class TrueGaps {
 public:
  TrueGaps(const Body& moving, const Body& fixed, const Pose& start, const Pose& end)
      : moving_(moving), fixed_(fixed), start_(start), end_(end), known_(moving.tree.nodes.size()) {
    for (std::vector<double>& row : known_) row.assign(fixed.tree.nodes.size(), kUnknown);
  }

  double minimum(std::uint32_t m, std::uint32_t f) {
    double& gap = known_[m][f];
    if (gap != kUnknown) return gap;
    const ObbNode &a = moving_.tree.nodes[m], &b = fixed_.tree.nodes[f];
    if (!a.leaf()) return gap = std::min(minimum(a.child, f), minimum(a.child + 1, f));
    if (!b.leaf()) return gap = std::min(minimum(m, b.child), minimum(m, b.child + 1));
    double found = 1e9;
    for (const double time : {0.0, 0.3, 0.5, 1.0})
      found = std::min(found, true_gap(at(pose_between(start_, end_, time), moving_.mesh.triangle(a.child)),
                                       fixed_.mesh.triangle(b.child)));
    return gap = found;
  }

 private:
  static constexpr double kUnknown = -1e30;
  const Body &moving_, &fixed_;
  Pose start_, end_;
  std::vector<std::vector<double>> known_;
};

/// @return the number of pairs of nodes with a claim
int expect_true(const Body& moving, const Body& fixed, const Pose& start, const Pose& end) {
  const RadialSweeps sweeps(*moving.revolution, moving.tree.origin, *fixed.revolution, fixed.tree.origin,
                            motion_of(moving, fixed, start, end));
  EXPECT_FALSE(sweeps.get().empty());
  // The deviation of the moving component's arcs from their chords is the caller's to add.
  const Screw screw = screw_between(start, end);
  const double arcs = screw_chord_deviation(screw, screw_radius(screw, start.position, 60));
  TrueGaps gaps(moving, fixed, start, end);
  int claims = 0;
  for (const RadialSweep& sweep : sweeps.get())
    for (std::uint32_t m = 0; m < moving.tree.nodes.size(); ++m)
      for (std::uint32_t f = 0; f < fixed.tree.nodes.size(); ++f) {
        const double claimed = sweep.gap(m, f, -0.2);
        claims += claimed > -0.2;
        EXPECT_GE(gaps.minimum(m, f), claimed - arcs - 1e-6) << m << ' ' << f;
      }
  return claims;
}

TEST(RadialSweep, NeverClaimsMoreThanTheGapOfTriangles) {
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 4; ++trial) {
    const double clearance = trial % 2 == 0 ? 0 : 0.05;
    const Pose frame = scenes::random_pose(random, trial < 2 ? 0 : 100, 3);
    const Body bush(scenes::moved(scenes::tube(14, 10, -10, 10, 32, 1), frame));
    const Body shaft(scenes::moved(scenes::tube(10 - clearance, 7, -15, 15, 30, 1), frame));
    const auto nearly = [&](double along) {
      const Pose shift = scenes::random_pose(random, 0.1, 0.01);
      const Pose turn{{0, 0, along}, quat_about({0, 0, 1}, scenes::random_vector(random, 0.3).x)};
      return frame * (shift * turn) * inverse(frame);
    };
    const Pose start = nearly(0), end = nearly(3);
    EXPECT_GT(expect_true(shaft, bush, start, end), 100);
    EXPECT_GT(expect_true(bush, shaft, start, end), 100);
  }
}

TEST(RadialSweep, ClaimsNoMoreWhereAShaftIsPastTheEndsOfItsBore) {
  std::mt19937_64 random(8);
  const Body bush(scenes::tube(14, 10, -10, 10, 20, 2));
  for (int trial = 0; trial < 6; ++trial) {
    // Facets of both, at the rim where a tilt brings them next to each other; the shaft begins before the end of the
    // bore or behind it.
    const double from = 10 + 0.4 * (trial - 2);
    const Body shaft(scenes::tube(trial % 2 ? 9.9 : 9, 7, from, from + 6, 18, 1));
    const Vec3 rim{0, 0, from};
    const auto tilted = [&](double along) {
      const Pose tilt{{}, quat_about(normalized(scenes::random_vector(random, 1)), 0.06)};
      const Vec3 moved = rim + scenes::random_vector(random, 0.2) + Vec3{0, 0, along};
      return Pose{moved, {}} * tilt * Pose{-rim, {}};
    };
    const Pose start = tilted(0), end = tilted(trial < 3 ? -1 : 0.5);
    EXPECT_GT(expect_true(shaft, bush, start, end), 100);
    EXPECT_GT(expect_true(bush, shaft, inverse(start), inverse(end)), 100);
  }
}

TEST(RadialSweep, ClaimsNoMoreOfAThinShaftThatLeansOverTheRimOfAWideBore) {
  // Nearest to the rim is what is a little past it, and it is nearer to the wall than what is beside the bore.
  const Body bush(scenes::tube(14, 10, 0, 10, 64, 1)), shaft(scenes::tube(1, 0, 10.05, 25, 24, 1));
  const Vec3 rim{0, 0, 10.05};
  for (const double heading : {0.0, 0.6, 2.2}) {
    const Vec3 axis{-std::sin(heading), std::cos(heading), 0};
    const Pose start = Pose{rim, {}} * Pose{{}, quat_about(axis, 0.095)} * Pose{-rim, {}};
    const Pose end = Pose{{0, 0, 0.01}, {}} * start;
    EXPECT_GT(expect_true(shaft, bush, start, end), 100);
    EXPECT_GT(expect_true(bush, shaft, inverse(start), inverse(end)), 100);
  }
}

TEST(RadialSweep, UsesOnlyAxesWithRoomBetweenTheirCylinders) {
  const auto used = [](const Body& moving, const Body& fixed, double aside) {
    const PairMotion motion = motion_of(moving, fixed, {{aside, 0, 0}, {}}, {{aside, 0, 1}, {}});
    return RadialSweeps(*moving.revolution, moving.tree.origin, *fixed.revolution, fixed.tree.origin, motion)
        .get()
        .size();
  };
  const Body shaft(scenes::tube(10, 0, -10, 10, 64, 1)), wider(scenes::tube(10.2, 0, -10, 10, 64, 1));
  for (const auto& [a, b] : {std::pair{&shaft, &wider}, {&wider, &shaft}}) {
    EXPECT_EQ(used(*a, *b, 0.1), 1u);
    EXPECT_EQ(used(*a, *b, 0.3), 0u);
  }
  // A bush has room for them in its bore, up to a share of the size.
  const Body bush(scenes::tube(14, 11, -10, 10, 64, 1));
  EXPECT_EQ(used(shaft, bush, 0.9), 1u);
  EXPECT_EQ(used(shaft, bush, 1.1), 0u);
  // Cylinders of one radius have none, but may be a press fit, with an axis that is rounded.
  EXPECT_EQ(used(shaft, shaft, 0), 1u);
  EXPECT_EQ(used(shaft, shaft, 1e-6), 1u);
}

TEST(RadialSweep, SeparatesAWholeShaftFromItsBore) {
  const Body bush(scenes::tube(14, 10, -10, 10, 64, 1)), shaft(scenes::tube(9.9, 0, -15, 15, 64, 1));
  for (const bool bush_moves : {false, true}) {
    const Body &moving = bush_moves ? bush : shaft, &fixed = bush_moves ? shaft : bush;
    const Pose end{{0.02, 0, 8}, quat_about({0, 0, 1}, 0.1)};
    const PairMotion motion = motion_of(moving, fixed, {}, end);
    const RadialSweeps sweeps(*moving.revolution, moving.tree.origin, *fixed.revolution, fixed.tree.origin, motion);
    ASSERT_EQ(sweeps.get().size(), 1u);
    EXPECT_GT(sweeps.get()[0].gap(0, 0, 0), 0.05) << bush_moves;
  }
}

TEST(RadialSweep, CertifiesAShaftInItsBoreUnderMotionsThatKeepItsAxis) {
  // Only the bore's wall: a node of the bush contains its outside, too.
  TriangleMesh wall = scenes::tube(14, 10, -10, 10, 64, 2);
  std::erase_if(wall.faces, [&](const Face& f) {
    const Vec3 v = wall.vertices[f.v[0]], n = normal_unscaled({{v, wall.vertices[f.v[1]], wall.vertices[f.v[2]]}});
    return n.x * v.x + n.y * v.y >= 0;
  });
  const Body bore(std::move(wall)), shaft(scenes::tube(9.9, 0, -15, 15, 48, 1));
  const double sagitta_of_bore = 10 * (1 - std::cos(std::acos(-1.0) / 64));
  const double sagitta_of_shaft = 9.9 * (1 - std::cos(std::acos(-1.0) / 48));
  for (const bool bore_moves : {false, true}) {
    const Body &moving = bore_moves ? bore : shaft, &fixed = bore_moves ? shaft : bore;
    const RadialSweeps sweeps(*moving.revolution, moving.tree.origin, *fixed.revolution, fixed.tree.origin,
                              motion_of(moving, fixed, {}, {{0.3, 0, 0}, {}}));
    ASSERT_EQ(sweeps.get().size(), 1u);
    const double together = sagitta_of_bore + sagitta_of_shaft;
    EXPECT_FALSE(sweeps.get()[0].fit(0, 0, 0.99 * together));
    const std::optional<CylinderFit> fit = sweeps.get()[0].fit(0, 0, 1.01 * together);
    ASSERT_TRUE(fit);
    EXPECT_EQ(fit->moving_inside, !bore_moves);
    EXPECT_NEAR(fit->radius, 9.9, 1e-5);
    EXPECT_NEAR(fit->room, 0.1 - sagitta_of_bore, 1e-5);
    EXPECT_NEAR(fit->radial_deviation, together, 1e-5);
    EXPECT_NEAR(fit->inner_end - fit->inner_begin, 30, 1e-4);
    EXPECT_NEAR(fit->outer_end - fit->outer_begin, 20, 1e-4);
  }
}

TEST(RadialSweeps, ConsiderOnlyAxesThatAreNear) {
  const Body bush(scenes::tube(14, 10, -10, 10, 64, 1)), shaft(scenes::tube(9.9, 0, -15, 15, 64, 1));
  for (const Pose& away : {Pose{{5, 0, 0}, {}}, Pose{{}, quat_about({1, 0, 0}, 0.3)}}) {
    const RadialSweeps sweeps(*shaft.revolution, shaft.tree.origin, *bush.revolution, bush.tree.origin,
                              motion_of(shaft, bush, away, away));
    EXPECT_TRUE(sweeps.get().empty());
  }
}

}  // namespace
}  // namespace dismantle
