// SPDX-License-Identifier: Apache-2.0
// Retractions of two components that overlap, and the points that they are found at.
#include "dismantle/certificates/ghosts/overlap_retraction.h"

#include "dismantle/math/angle.h"
#include "tests/support/meshes.h"
#include "tests/support/swept_meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace dismantle {
namespace {

constexpr double kTolerance = 0.001;

/// A component with its tree and its shape.
struct Solid {
  explicit Solid(const TriangleMesh& mesh)
      : component(scenes::component("solid", mesh)), tree(make_solid_tree(component, {})), shape(component) {}
  OverlapSide side() const {
    return {&tree, [this]() -> const SolidShape& { return shape; }};
  }
  Component component;
  SolidTree tree;
  SolidShape shape;
};

/// Two boxes, the second one 0.2 deep in the upper side of the first one.
struct StackedBoxes {
  Solid low{scenes::box({0, 0, 0}, {10, 10, 5})}, high{scenes::box({3, 3, 4.8}, {7, 7, 9})};
};

TEST(OverlapSamples, AreWhereTheShapeHasThem) {
  const StackedBoxes boxes;
  const OverlapSide in_low = boxes.low.side(), in_high = boxes.high.side();
  const double depth = 0.3;
  for (const auto& [surface, solid] : {std::pair(&boxes.low, &in_high), std::pair(&boxes.high, &in_low)}) {
    const SurfaceEdges edges(surface->tree);
    OverlapSamples samples(surface->tree, edges, *solid, depth);
    std::map<std::size_t, Vec3> known;
    std::size_t inside = 0, near = 0;
    // Twice: what is kept is the same.
    for (int round = 0; round < 2; ++round)
      samples.for_each([&](std::uint32_t, const OverlapSamples::Sample& sample) {
        const auto found = samples.nearest(sample);
        const double exact = solid->shape().surface().distance(sample.point).distance;
        if (exact <= depth) {
          EXPECT_NEAR(found.distance, exact, 1e-12);
        } else {
          EXPECT_GT(found.distance, depth);
        }
        EXPECT_EQ(samples.inside(sample), solid->shape().winding().inside(sample.point));
        near += exact <= depth;
        inside += samples.inside(sample);
        const auto [entry, is_new] = known.emplace(sample.slot, sample.point);
        const bool is_kept = sample.slot < 4 * surface->tree.faces.size();
        EXPECT_TRUE(is_new || !is_kept || entry->second == sample.point);
      });
    EXPECT_GT(near, 0u);
    EXPECT_GT(inside, 0u);
  }
}

TEST(PairOverlap, RetractsTheFacesThroughWhichPointsGetOut) {
  const StackedBoxes boxes;
  const OverlapSide low = boxes.low.side(), high = boxes.high.side();
  PairOverlap overlap(low, high, 0.2 + 1e-6, kTolerance);
  EXPECT_EQ(overlap.turning(), 0);
  for (const bool of_a : {true, false}) {
    const OverlapRetraction& found = overlap.retraction(of_a);
    const SolidTree& tree = of_a ? boxes.low.tree : boxes.high.tree;
    ASSERT_EQ(found.needed.size(), tree.faces.size());
    for (std::uint32_t f = 0; f < tree.faces.size(); ++f) {
      const double up = normalized(normal_unscaled(tree.triangle(f))).z;
      EXPECT_NEAR(found.needed[f], up == (of_a ? 1 : -1) ? 0.2 : 0, 1e-9) << of_a << f;
      // The two halves of each side are one patch, and no two sides are.
      for (std::uint32_t g = 0; g < tree.faces.size(); ++g)
        EXPECT_EQ(found.patch[f] == found.patch[g],
                  dot(normal_unscaled(tree.triangle(f)), normal_unscaled(tree.triangle(g))) > 0);
    }
  }
}

TEST(PairOverlap, IsTheSameWhicheverComponentIsFirst) {
  const Solid shaft(scenes::tube(5.1, 1, -5, 15, 40, 4)), ring(scenes::tube(9, 5, 0, 10, 36, 3));
  const OverlapSide a = shaft.side(), b = ring.side();
  PairOverlap there(a, b, 0.12, kTolerance), back(b, a, 0.12, kTolerance);
  for (const bool of_a : {true, false}) {
    EXPECT_EQ(there.retraction(of_a).needed, back.retraction(!of_a).needed);
    EXPECT_EQ(there.retraction(of_a).patch, back.retraction(!of_a).patch);
    EXPECT_GT(there.retraction(of_a).needed, std::vector<double>(there.retraction(of_a).needed.size()));
  }
  EXPECT_EQ(there.turning(), back.turning());
}

TEST(PairOverlap, LeavesTheFaceAroundABoreWhereThePointsGetOutThroughItsWall) {
  // Vertices of the shaft are 0.1 deep in the wall of the bore, and 0.05 below the face that it opens in.
  for (const double angle : {0.0, 0.7, 2.1}) {
    const Pose pose{{30, -20, 10}, quat_about(normalized(Vec3{1, 2, 3}), angle)};
    const Vec3 axis = mat3_from_quat(pose.rotation) * Vec3{0, 0, 1};
    const Solid shaft(scenes::moved(scenes::tube(5.1, 1, -5.05, 14.95, 40, 4), pose));
    const Solid ring(scenes::moved(scenes::tube(9, 5, 0, 10, 40, 3), pose));
    const OverlapSide a = shaft.side(), b = ring.side();
    PairOverlap overlap(a, b, 0.1 + 1e-6, kTolerance);
    const OverlapRetraction& found = overlap.retraction(false);
    for (std::uint32_t f = 0; f < ring.tree.faces.size(); ++f) {
      const Triangle t = ring.tree.triangle(f);
      const bool in_bore = length(cross(t[0] - pose.position, axis)) < 6 &&
                           length(cross(t[1] - pose.position, axis)) < 6 &&
                           length(cross(t[2] - pose.position, axis)) < 6;
      EXPECT_GE(found.needed[f], in_bore ? 0.1 - 1e-6 : 0) << angle;
      EXPECT_LE(found.needed[f], in_bore ? 0.12 : 0) << angle;
    }
  }
}

TEST(PairOverlap, RetractsAFaceThatASharpEdgeIsPressedInto) {
  const Solid block(scenes::box({0, 0, 0}, {10, 10, 5}));
  const Solid blade(scenes::moved(scenes::extruded({{0, 0}, {0.3, 6}, {-0.3, 6}}, -4, 4),
                                  {{5, 5, 4.8}, quat_about({1, 0, 0}, kTurn / 4)}));
  const OverlapSide a = block.side(), b = blade.side();
  PairOverlap overlap(a, b, 0.2 + 1e-6, kTolerance);
  const OverlapRetraction& found = overlap.retraction(true);
  for (std::uint32_t f = 0; f < block.tree.faces.size(); ++f)
    EXPECT_NEAR(found.needed[f], normalized(normal_unscaled(block.tree.triangle(f))).z > 0.5 ? 0.2 : 0, 1e-9);
}

TEST(TurningRetraction, IsWhatCornersNeedToPassTheMiddlesOfFacets) {
  // Equal prisms: corners of the shaft are beyond the middles of the bore's facets by the sagitta.
  for (const std::uint32_t sides : {12u, 36u, 200u}) {
    const Solid shaft(scenes::tube(5, 1, -5, 15, sides, 2)), ring(scenes::tube(9, 5, 0, 10, sides, 2));
    const double sagitta = 5 * (1 - std::cos(kTurn / 2 / sides));
    for (const bool of_shaft : {true, false}) {
      const SolidTree &own = of_shaft ? shaft.tree : ring.tree, &other = of_shaft ? ring.tree : shaft.tree;
      const TurningRetraction found = turning_retraction(own, other, 0.01, kTolerance);
      EXPECT_NEAR(found.largest, sagitta, 1e-9) << sides;
      for (std::uint32_t f = 0; f < own.faces.size(); ++f) {
        const Triangle t = own.triangle(f);
        const auto at_5 = [](Vec3 p) { return std::abs(std::hypot(p.x, p.y) - 5) < 1e-6; };
        EXPECT_NEAR(found.needed[f], at_5(t[0]) && at_5(t[1]) && at_5(t[2]) ? sagitta : 0, 1e-9);
      }
    }
  }
}

TEST(TurningRetraction, IsNoMoreThanTheDepthAndBothSagittasWhereRadiiDiffer) {
  // The audit accepts no more. Every other ring of corners of the shaft is 0.01 beyond the bore, but rests beside it.
  TriangleMesh uneven = scenes::tube(5, 1, -5, 15, 200, 8);
  for (Vec3& p : uneven.vertices) {
    if (std::hypot(p.x, p.y) < 4) continue;
    const double factor = std::fmod(p.z + 5, 5) < 1 ? 5.0099 / 5 : 4.99 / 5;
    p = {factor * p.x, factor * p.y, p.z};
  }
  const Solid shaft(uneven), ring(scenes::tube(9, 5, 0, 10, 200, 2));
  const double sagitta = 5 * (1 - std::cos(kTurn / 2 / 200)), depth = 0.001, tolerance = 0.02;
  for (const bool of_shaft : {true, false}) {
    const SolidTree &own = of_shaft ? shaft.tree : ring.tree, &other = of_shaft ? ring.tree : shaft.tree;
    const TurningRetraction found = turning_retraction(own, other, depth, tolerance);
    EXPECT_GT(found.largest, depth);
    EXPECT_LE(found.largest, depth + 2 * 1.01 * sagitta);
  }
}

TEST(TurningRetraction, IsNothingForBarsAndForThoseThatAreClear) {
  const Solid bar(scenes::tube(5, 1, -5, 15, 8, 2)), hole(scenes::tube(9, 5, 0, 10, 8, 2));
  EXPECT_EQ(turning_retraction(bar.tree, hole.tree, 0.01, kTolerance).largest, 0);
  const Solid thin(scenes::tube(4.9, 1, -5, 15, 36, 2)), ring(scenes::tube(9, 5, 0, 10, 36, 2));
  EXPECT_EQ(turning_retraction(thin.tree, ring.tree, 0.01, kTolerance).largest, 0);
}

}  // namespace
}  // namespace dismantle
