// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/depth/swept_depth.h"

#include "dismantle/surface/depth/solid_depth.h"

#include "dismantle/surface/depth/moving_part_search.h"
#include "dismantle/surface/depth/near_two_faces.h"
#include "dismantle/surface/depth/nowhere_deeper.h"
#include "tests/support/depth_oracle.h"
#include "tests/support/faulty_meshes.h"
#include "tests/support/gear_meshes.h"
#include "tests/support/random_scenes.h"
#include "tests/support/shaped_solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace dismantle {
namespace {

using Solid = scenes::ShapedSolid;

RigidTransform moved(Vec3 by) {
  RigidTransform result;
  result.translation = by;
  return result;
}

/// The depth of sampled points of one mesh, whose points are a share `time` of their straight way, inside the other.
double sampled_depth(const TriangleMesh& mesh, const TriangleMesh& other, const RigidTransform& start,
                     const RigidTransform& end, double time, double step) {
  double deepest = 0;
  const auto at = [&](Vec3 p) { return (1 - time) * (start * p) + time * (end * p); };
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle t = mesh.triangle(f);
    oracle::for_each_sample(at(t[0]), at(t[1]), at(t[2]), step, [&](Vec3 p) {
      if (std::abs(oracle::winding_number(other, p)) > 0.5 + kUndecidedWinding)
        deepest = std::max(deepest, oracle::distance(other, p));
    });
  }
  return deepest;
}

double sampled_depth(const TriangleMesh& a, const TriangleMesh& b, const RigidTransform& end, double time,
                     double step) {
  return std::max(sampled_depth(a, b, {}, end, time, step), sampled_depth(b, a, {}, inverse(end), time, step));
}

/// Pieces for searches that a faulty surface leaves undecided, however many there are.
constexpr std::size_t kMaxUndecidedPieces = 20000;

/// Expects that nothing sampled is deeper than the limit before `free_until`, and that the point found is.
void expect_right(const TriangleMesh& a, const TriangleMesh& b, const RigidTransform& end, double limit,
                  double resolution, bool decided) {
  const Solid first(a), second(b);
  const std::size_t max_pieces = decided ? kMaxSweptPieces : kMaxUndecidedPieces;
  const auto found = first_deeper({&first.shape, &second.shape, {}, end}, {limit}, resolution, max_pieces);
  const double free_until = found ? found->free_until : 1;
  for (const double share : {0.0, 0.2, 0.5, 0.8, 1.0})
    if (free_until > 0) {
      EXPECT_LE(sampled_depth(a, b, end, share * free_until, 0.5), limit + 1e-9) << "at " << share * free_until;
    }
  if (!found) return;
  EXPECT_LE(found->free_until, found->time);
  if (!decided) return;
  EXPECT_LE(found->time - found->free_until, resolution * (1 + 1e-9));
  const TriangleMesh& outer = found->of_a ? b : a;
  EXPECT_GT(oracle::distance(outer, found->point), limit - 1e-9);
  EXPECT_NEAR(oracle::distance(outer, found->nearest), 0, 1e-9);
  EXPECT_NEAR(length(found->point - found->nearest), oracle::distance(outer, found->point), 1e-9);
  EXPECT_GT(std::abs(oracle::winding_number(outer, found->point)), 0.5 - kUndecidedWinding);
}

TEST(FirstDeeper, FindsWhenABoxGetsTooDeep) {
  const Solid box(scenes::box({0, 0, 0}, {10, 10, 10})), other(scenes::box({3, 3, 8}, {7, 7, 20}));
  const SweptPair down{&other.shape, &box.shape, {}, moved({0, 0, -1})};
  const auto found = first_deeper(down, {2.25}, 1e-3);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->of_a);
  EXPECT_LE(found->free_until, 0.25 + 1e-9);
  EXPECT_NEAR(found->free_until, 0.25, 1e-3 * (1 + 1e-9));
  EXPECT_GT(found->time, 0.25);
  EXPECT_FALSE(first_deeper(down, {3.01}, 1e-3));
  EXPECT_FALSE(first_deeper({&other.shape, &box.shape, {}, moved({0, 0, 30})}, {2.01}, 1e-3));
  EXPECT_TRUE(first_deeper(down, {1.9}, 1e-3));  // too deep from the beginning
  EXPECT_EQ(first_deeper(down, {1.9}, 1e-3)->free_until, 0);
}

TEST(FirstDeeper, IsTheSameForBothRoles) {
  const Solid box(scenes::box({0, 0, 0}, {10, 10, 10})), other(scenes::box({3, 3, 8}, {7, 7, 20}));
  const auto found = first_deeper({&box.shape, &other.shape, {}, moved({0, 0, 1})}, {2.25}, 1e-3);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->of_a);
  EXPECT_NEAR(found->free_until, 0.25, 1e-3 * (1 + 1e-9));
}

TEST(FirstDeeper, ProvesLongMotionsAlongASharedAxisWithFewPieces) {
  const Solid hole(scenes::tube(12, 3.3, 0, 20, 24)), peg(scenes::tube(4, 0, -5, 35, 31));
  EXPECT_FALSE(first_deeper({&peg.shape, &hole.shape, {}, moved({0, 0, 60})}, {0.76}, 1e-4, 20000));
  const auto sideways = first_deeper({&peg.shape, &hole.shape, {}, moved({2, 0, 0})}, {0.76}, 1e-4);
  ASSERT_TRUE(sideways);
  EXPECT_LT(sideways->time * 2, 0.1);
}

TEST(FirstDeeper, ProvesThatAGearComesOffAWiderOneAlongItsAxis) {
  // The ends of the narrow gear are as deep in the wide one wherever they are.
  scenes::Gear narrow, wide;
  narrow.width = 20;
  wide.width = 70;
  const TriangleMesh first = scenes::gear_mesh(narrow);
  TriangleMesh second = scenes::gear_mesh(wide);
  for (Vec3& p : second.vertices) p += {2 * wide.pitch_radius() - 0.4, 0, -10};
  const Solid a(first), b(second);
  const double depth = solid_depth({&a.shape, {}}, {&b.shape, {}}, {1e-4, 1e-4, 1000000}).depth;
  ASSERT_GT(depth, 1);
  EXPECT_FALSE(first_deeper({&a.shape, &b.shape, {}, moved({0, 0, 80})}, {depth + 0.01}, 1e-4));
  // Of two that are equally wide, an end gets deeper than the flanks are.
  TriangleMesh third = first;
  for (Vec3& p : third.vertices) p.x += 2 * narrow.pitch_radius() - 0.4;
  const Solid c(third);
  const double flanks = solid_depth({&a.shape, {}}, {&c.shape, {}}, {1e-4, 1e-4, 1000000}).depth;
  const auto found = first_deeper({&a.shape, &c.shape, {}, moved({0, 0, 80})}, {flanks + 1e-3}, 1e-4);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->time * 80, flanks, 0.05);
}

TEST(FirstDeeper, KeepsPointsThatAreFarFromAThinPartOutOfIt) {
  // The end of a beam is half as deep in a plate as that is thick: by its depth alone, all of the beam could go
  // through.
  const Solid plate(scenes::box({-5, -5, 0}, {5, 5, 1})), beam(scenes::box({-0.4, -0.4, 0.5}, {0.4, 0.4, 10}));
  const double limit = 0.51, tolerance = 0.01;
  ASSERT_TRUE(is_nowhere_deeper(plate.shape, limit));
  ASSERT_TRUE(is_nowhere_deeper(beam.shape, limit));
  const auto sweep = [&](Vec3 way, const DepthLimits& limits) {
    return first_deeper({&beam.shape, &plate.shape, {}, moved(way)}, limits, 1e-4);
  };
  EXPECT_FALSE(sweep({0, 0, -6}, {limit, limit, limit}));
  const DepthLimits limits{limit, tolerance, limit};
  EXPECT_FALSE(sweep({0, 0, 20}, limits));
  const auto down = sweep({0, 0, -6}, limits);
  ASSERT_TRUE(down);
  EXPECT_TRUE(down->of_a);
  // Points of the sides that are 0.51 above the plate get in until they are as deep as the tolerance. So many do at the
  // same time that the last parts of the motion are left undecided: two resolutions.
  EXPECT_NEAR(6 * down->free_until, limit + tolerance, 2 * 6e-4);
  EXPECT_FALSE(sweep({0, 0, -0.5}, limits));
  const auto swapped = first_deeper({&plate.shape, &beam.shape, {}, moved({0, 0, 6})}, {limit, limit, tolerance}, 1e-4);
  ASSERT_TRUE(swapped);
  EXPECT_FALSE(swapped->of_a);
  EXPECT_NEAR(swapped->free_until, down->free_until, 1e-4);
}

TEST(NowhereDeeper, IsTrueFromTheRadiusOfTheLargestBallOn) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 20; ++i) {
    const Pose at = scenes::random_pose(random, 2, 3);
    const Solid plate(scenes::moved(scenes::box({0, 0, 0}, {6, 4, 0.5}), at));
    EXPECT_FALSE(is_nowhere_deeper(plate.shape, 0.249));
    EXPECT_TRUE(is_nowhere_deeper(plate.shape, 0.251));
    const std::uint32_t sides = 8 + static_cast<std::uint32_t>(2 * i);
    const Solid rod(scenes::moved(scenes::tube(2, 0, 0, 20, sides), at));
    const double radius = 2 * std::cos(std::numbers::pi / sides);
    EXPECT_FALSE(is_nowhere_deeper(rod.shape, 0.999 * radius));
    EXPECT_TRUE(is_nowhere_deeper(rod.shape, 1.001 * radius));
    const Solid ring(scenes::moved(scenes::tube(3, 2, 0, 0.4, 48), at));
    EXPECT_FALSE(is_nowhere_deeper(ring.shape, 0.199));
    EXPECT_TRUE(is_nowhere_deeper(ring.shape, 0.201));
  }
  TriangleMesh open = scenes::box({0, 0, 0}, {6, 4, 0.5});
  open.faces.resize(open.faces.size() - 2);
  EXPECT_FALSE(is_nowhere_deeper(Solid(open).shape, 100));
}

TEST(StaysShallow, TellsHowDeepATriangleGetsOnItsWay) {
  const Solid box(scenes::box({0, 0, 0}, {10, 10, 10}));
  std::size_t pieces = 0;
  const auto stays = [&](const Triangle& from, const Triangle& to, double limit) {
    return stays_shallow(box.shape, from, to, limit, pieces, 10000);
  };
  // A face of an edge whose corners move diagonally inwards gets as deep as each of the two faces is retracted.
  const Triangle face{{{0, 0, 0}, {10, 0, 0}, {10, 0, 10}}}, moved{{{1, 1, 0}, {9, 1, 0}, {9, 1, 10}}};
  EXPECT_TRUE(stays(face, moved, 1.001));
  EXPECT_FALSE(stays(face, moved, 0.999));
  // A triangle that starts in the middle of the box, at its deepest, and leaves it.
  const Triangle inside{{{4, 5, 5}, {6, 5, 5}, {5, 6, 5}}}, outside{{{4, -5, 5}, {6, -5, 5}, {5, -4, 5}}};
  EXPECT_FALSE(stays(inside, outside, 4.9));
  EXPECT_TRUE(stays(inside, outside, 5.001));
  EXPECT_GT(pieces, 0u);
  pieces = 0;
  EXPECT_FALSE(stays_shallow(box.shape, inside, outside, 5.001, pieces, 0));  // undecided
}

TEST(FirstDeeper, ThatCannotBeDecidedStopsEarlierInsteadOfLater) {
  const Solid box(scenes::box({0, 0, 0}, {10, 10, 10})), other(scenes::box({3, 3, 8}, {7, 7, 20}));
  const auto found = first_deeper({&other.shape, &box.shape, {}, moved({0, 0, -1})}, {2.25}, 1e-3, 1);
  ASSERT_TRUE(found);
  EXPECT_LT(found->free_until, 0.25);
}

TEST(FirstDeeper, ProvesThatAPegCrossesTheMiddleOfAPlateThatIsNowhereDeeper) {
  // Half-way between the faces of the plate, points are within the limit of either face, and no part is of one alone.
  const Solid plate(scenes::tube(20, 3.25, -1, 1, 48)), peg(scenes::tube(4.25, 0, -1.5, 9, 64));
  const double depth = solid_depth({&peg.shape, {}}, {&plate.shape, {}}, {1e-4, 1e-4, 1000000}).depth;
  ASSERT_NEAR(depth, 1, 0.01);
  EXPECT_FALSE(first_deeper({&peg.shape, &plate.shape, {}, moved({0, 0, -30})}, {depth + 0.003}, 1e-4, 20000));
}

TEST(NearTwoFaces, IsTrueOnlyWhereEverySampledPointIsNear) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> u(-1, 1);
  int divided = 0;
  for (const TriangleMesh& mesh : {scenes::box({-4, -4, -0.5}, {4, 4, 0.5}), scenes::tube(3, 2.2, -2, 2, 9)}) {
    const Solid solid(mesh);
    const SurfaceTree& surface = solid.shape.surface();
    for (int i = 0; i < 20000; ++i) {
      const Vec3 middle{3 * u(random), 3 * u(random), u(random)};
      const double size = 0.5 + 0.4 * u(random), limit = 0.5 + 0.2 * u(random);
      std::vector<Vec3> corners;
      for (int k = 0; k < 4 + i % 5; ++k) corners.push_back(middle + size * Vec3{u(random), u(random), u(random)});
      const std::uint32_t face = surface.distance(middle).face;
      if (!near_two_faces(surface, Span<const Vec3>(corners.data(), corners.size()), face, limit)) continue;
      divided += std::any_of(corners.begin(), corners.end(),
                             [&](Vec3 p) { return surface.distance_to_face(p, face) > limit; });
      for (int k = 0; k < 30; ++k) {
        Vec3 p;
        double sum = 0;
        for (const Vec3& corner : corners) {
          const double share = k < 15 ? std::pow(std::abs(u(random)), 8) : std::abs(u(random));
          p += share * corner;
          sum += share;
        }
        ASSERT_LE(oracle::distance(mesh, p / sum), limit + 1e-9) << "hull " << i;
      }
    }
  }
  EXPECT_GT(divided, 500);
}

TEST(FirstDeeper, DecidesTheSameForAnyPointAsForTheFirst) {
  std::mt19937_64 random(23);
  int deep = 0, free = 0;
  for (int i = 0; i < 60; ++i) {
    const Solid a(scenes::tube(2, i % 3 == 0 ? 1 : 0, -2, 2, 5 + static_cast<std::uint32_t>(i % 7)));
    const TriangleMesh second = scenes::box({-2, -1.5, -1}, {2, 1.5, 1});
    const Solid b(second);
    const RigidTransform start = transform_from_pose(scenes::random_pose(random, 4, 1)),
                         end = transform_from_pose(scenes::random_pose(random, 3, 0.4)) * start;
    const SweptPair pair{&a.shape, &b.shape, start, end};
    const DepthLimits limits{0.2 + 0.015 * i};
    const auto first = first_deeper(pair, limits, 0.01);
    const auto any = first_deeper(pair, limits, 0.01, kMaxSweptPieces, {}, DeepSearch::Any);
    ASSERT_EQ(first.has_value(), any.has_value()) << i;
    (any ? deep : free) += 1;
    if (!any) continue;
    EXPECT_LE(any->free_until, first->time + 1e-9) << i;
    const TriangleMesh& outer = any->of_a ? second : *a.component.mesh;
    EXPECT_GT(oracle::distance(outer, any->point), limits.limit - 1e-9) << i;
    EXPECT_GT(std::abs(oracle::winding_number(outer, any->point)), 0.5) << i;
  }
  EXPECT_GT(deep, 10);
  EXPECT_GT(free, 5);
}

TEST(FirstDeeper, FindsAnyPointOfAFineSurfaceWithFewSamples) {
  // A fine rod in a long bore that ends at a lid; on the way there, it is nearly as deep in the wall as allowed.
  const Solid rod(scenes::tube(5.0145, 0, -5, 5, 200, 40));
  const Solid bore(scenes::joined(scenes::tube(6, 5.005, -5, 100, 200, 40), scenes::box({-6, -6, 100}, {6, 6, 300})));
  std::size_t cost = 0;
  const auto found = first_deeper({&rod.shape, &bore.shape, {}, moved({0, 0, 800})}, {0.01}, 1e-5, kMaxSweptPieces, {},
                                  DeepSearch::Any, &cost);
  ASSERT_TRUE(found);
  EXPECT_GT(found->point.z, 100);
  EXPECT_LT(cost, 3000u) << "points";
}

TEST(FirstDeeper, AgreesWithSamplesOfRandomSolidsClosedCrackedAndOpen) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int i = 0; i < 30; ++i) {
    TriangleMesh a = scenes::tube(2, i % 3 == 0 ? 1 : 0, -2, 2, 5 + i % 7),
                 b = scenes::box({-2, -1.5, -1}, {2, 1.5, 1});
    const RigidTransform tilt = transform_from_pose(scenes::random_pose(random, 1.5, 1));
    for (Vec3& p : a.vertices) p = tilt * p;
    const int fault = i % 5;
    if (fault == 1) a = scenes::torn_apart(a, 1e-9);
    if (fault == 2) b = scenes::without_face(b, static_cast<std::size_t>(i) % b.faces.size());
    if (fault == 3) a = scenes::inside_out(a);
    if (fault == 4) b = scenes::joined(b, scenes::inside_out(scenes::box({-1, -1, -0.6}, {1, 1, 0.6})));
    const RigidTransform end = transform_from_pose(scenes::random_pose(random, 1.5, 0.4));
    const double start = sampled_depth(a, b, end, 0, 0.2);
    for (const double more : {0.02, 0.3}) {
      SCOPED_TRACE(testing::Message() << "scene " << i << " limit " << start + more);
      expect_right(a, b, end, start + more, 0.01, fault != 1 && fault != 2);
    }
  }
}

}  // namespace
}  // namespace dismantle
