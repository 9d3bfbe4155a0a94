// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/sweep/triangle_pair_sweep.h"

#include "dismantle/certificates/ghosts/find_pair_ghosts.h"
#include "dismantle/math/vec3f.h"
#include "dismantle/narrowphase/distance_triangle_triangle.h"
#include "tests/support/random_scenes.h"
#include "tests/support/solid_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace dismantle {
namespace {

using scenes::Solid;

constexpr std::uint64_t kSeed = 86;
constexpr int kPlaces = 24;

/// A component near another one, and a screw on which chords and arcs differ by at most kArcShare of the tolerance.
struct Scene {
  Solid moving, fixed;
  Pose start, end;
  double deviation, tolerance;

  explicit Scene(std::mt19937_64& random)
      : moving(scenes::moved(scenes::tube(0.8, 0.3, -1, 1, 7, 1), scenes::random_pose(random, 2, 3))),
        fixed(scenes::moved(scenes::box({-1, -1.5, -0.5}, {1, 1.5, 0.5}), scenes::random_pose(random, 2, 3))) {
    const Vec3 near = assembled_bounds(fixed.assembly.components[0]).center(),
               own = assembled_bounds(moving.assembly.components[0]).center();
    const Pose turn = scenes::random_pose(random, 0, 3);
    start = {near + scenes::random_vector(random, 2) - transform_from_pose(turn) * own, turn.rotation};
    end = start * scenes::random_pose(random, 1, 0.6);
    const Vec3 at = transform_from_pose(start) * own;
    deviation = screw_motion(start, end, at, 1.3).deviation;
    tolerance = (deviation + 1e-9) / kArcShare;
  }

  TrianglePairSweep sweep() const {
    return TrianglePairSweep(moving.tree, fixed.tree, start, end, deviation, tolerance);
  }
  Triangle on_chord(std::uint32_t face, double s) const {
    Triangle t = moving.tree.triangle(face);
    const RigidTransform from = transform_from_pose(start), to = transform_from_pose(end);
    for (Vec3& p : t.corner) p = (1 - s) * (from * p) + s * (to * p);
    return t;
  }
  Triangle on_arc(std::uint32_t face, double s) const {
    Triangle t = moving.tree.triangle(face);
    const RigidTransform at = transform_from_pose(pose_between(start, end, s));
    for (Vec3& p : t.corner) p = at * p;
    return t;
  }
};

/// None, any axis, or one that separates the two at some time of the motion.
Vec3 some_hint(std::mt19937_64& random, const Triangle& moving, const Triangle& fixed) {
  if (random() % 4 == 0) return {};
  const TriangleDistance nearest = distance_triangle_triangle(moving, fixed);
  if (random() % 2 == 0 && nearest.distance > 0) return normalized(nearest.point_b - nearest.point_a);
  return normalized(scenes::random_vector(random, 1));
}

TEST(TrianglePairSweep, IsFreeOnlyWhereTheChordsAreAndClaimsNoMoreThanTheGap) {
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> uniform;
  int free = 0, blocked = 0, gaps = 0;
  for (int i = 0; i < 200; ++i) {
    const Scene scene(random);
    const TrianglePairSweep sweep = scene.sweep();
    for (int k = 0; k < 30; ++k) {
      const auto a = static_cast<std::uint32_t>(random() % scene.moving.tree.faces.size()),
                 b = static_cast<std::uint32_t>(random() % scene.fixed.tree.faces.size());
      const Triangle other = scene.fixed.tree.triangle(b);
      const double horizon = k % 3 == 0 ? 0.1 + 0.8 * uniform(random) : 1;
      const Vec3 hint = some_hint(random, scene.on_chord(a, uniform(random)), other);
      const TrianglePairResult found = sweep.test(a, b, hint, horizon);
      const double until = found.free ? horizon : found.contact.toi;
      EXPECT_LE(until, horizon);
      (found.free ? free : blocked) += 1;
      gaps += found.gap > 0 ? 1 : 0;
      const double axis = length(found.contact.axis);
      EXPECT_TRUE(axis == 0 || std::fabs(axis - 1) < 1e-12);
      for (int place = 0; place <= kPlaces; ++place) {
        const double s = place / static_cast<double>(kPlaces);
        if (found.free || until > 0) {
          EXPECT_GT(distance_triangle_triangle(scene.on_chord(a, s * until), other).distance, 0)
              << "seed " << kSeed << ", scene " << i << ", pair " << k << ", time " << s * until;
        }
        EXPECT_GE(distance_triangle_triangle(scene.on_arc(a, s), other).distance, found.gap - 1e-12)
            << "seed " << kSeed << ", scene " << i << ", pair " << k << ", time " << s;
      }
    }
  }
  EXPECT_GT(free, 2000);
  EXPECT_GT(blocked, 200);
  EXPECT_GT(gaps, 1000);
}

/// The certificate's plane has the fixed triangle beyond it, and its hull is the moving triangle.
TEST(TrianglePairSweep, GivesCertificatesOfItsTriangles) {
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 400; ++i) {
    const Scene scene(random);
    const TrianglePairSweep sweep = scene.sweep();
    const auto a = static_cast<std::uint32_t>(random() % scene.moving.tree.faces.size()),
               b = static_cast<std::uint32_t>(random() % scene.fixed.tree.faces.size());
    const Triangle own = scene.moving.tree.triangle(a), other = scene.fixed.tree.triangle(b);
    const TrianglePairResult found = sweep.test(a, b, some_hint(random, scene.on_chord(a, 0.5), other));
    const Certificate certificate = sweep.certificate(found);
    if (length(found.contact.axis) == 0) continue;
    const Vec3 center = to_double(certificate.hull.center);
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(dot(to_double(certificate.axis), other[k] - scene.fixed.tree.tree.origin), certificate.offset);
      const Vec3 corner = k == 0 ? center : center + to_double(certificate.hull.span[k - 1]);
      EXPECT_LT(length(corner - (own[k] - scene.moving.tree.tree.origin)), 1e-6);
    }
  }
}

/// Arcs may deviate by what the displacements of ghosts leave of the tolerance, and fronts know of all of the rest.
TEST(TrianglePairSweep, KeepsNoMoreForArcsThanGhostsLeave) {
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 100; ++i) {
    const Scene scene(random);
    const PairMotion motion = scene.sweep().motion();
    EXPECT_LE(kGhostLength * scene.tolerance + motion.kept, scene.tolerance);
    EXPECT_GE(motion.deviation + motion.kept, scene.deviation);
  }
}

}  // namespace
}  // namespace dismantle
