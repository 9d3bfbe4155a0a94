// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/wide_bvh.h"

#include "dismantle/bvh/bvh_build.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace dismantle {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Random boxes, some of them flat, as leaves of a binary BVH and of a wide one.
struct Boxes {
  std::vector<Aabb> of_triangles, of_nodes;
  Bvh bvh;
  WideBvh wide;

  Boxes(std::mt19937_64& random, std::size_t count, Vec3 center, double size) {
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 p = center + scenes::random_vector(random, size);
      Vec3 half = 0.1 * scenes::random_vector(random, size);
      if (i % 3 == 0) half.z = 0;
      Aabb box;
      box.extend(p - half);
      box.extend(p + half);
      of_triangles.push_back(box);
    }
    const std::vector<std::uint32_t> begin{0, static_cast<std::uint32_t>(count)};
    bvh = bvh_build({of_triangles, begin}, {});
    of_nodes.resize(bvh.node_count());
    for (NodeIndex node = 0; node < bvh.node_count(); ++node) {
      if (node < bvh.leaf_count()) {
        of_nodes[node] = of_triangles[bvh.leaf_triangle[node]];
        continue;
      }
      const BvhChildren children = bvh.children[node - bvh.leaf_count()];
      of_nodes[node].extend(of_nodes[children.left]);
      of_nodes[node].extend(of_nodes[children.right]);
    }
    wide = WideBvh(bvh, of_nodes);
  }

  /// Calls visit(node, k, box) for every child of every node; the box is the smallest one in double.
  template <class Visit>
  Aabb for_each_child(const WideBvh::Node& node, const Visit& visit) const {
    Aabb all;
    for (int k = 0; k < WideBvh::kWidth; ++k) {
      if (!(node.lower[0][k] <= node.upper[0][k])) continue;
      const std::uint32_t child = node.child[k];
      const Aabb box =
          (child & WideBvh::kLeaf) != 0 ? of_triangles[child & ~WideBvh::kLeaf] : for_each_child(wide[child], visit);
      visit(node, k, box);
      all.extend(box);
    }
    return all;
  }
};

double squared_distance(const Aabb& box, Vec3 p) {
  const Vec3 outside = max(max(box.lower - p, p - box.upper), Vec3{});
  return dot(outside, outside);
}

/// True if the ray from `p` meets the box, by the definition.
bool meets(const Aabb& box, Vec3 p, Vec3 direction) {
  double enter = 0, leave = kInfinite;
  for (int i = 0; i < 3; ++i) {
    if (direction[i] == 0) {
      if (p[i] < box.lower[i] || p[i] > box.upper[i]) return false;
      continue;
    }
    const double a = (box.lower[i] - p[i]) / direction[i], b = (box.upper[i] - p[i]) / direction[i];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

TEST(WideBvh, HasEveryTriangleOnceAndFullNodes) {
  std::mt19937_64 random(1);
  for (const std::size_t count : {1, 2, 3, 4, 5, 16, 1000}) {
    const Boxes boxes(random, count, {}, 10);
    std::vector<int> seen(count, 0);
    std::size_t children = 0;
    boxes.for_each_child(boxes.wide.root(), [&](const WideBvh::Node& node, int k, const Aabb&) {
      ++children;
      if ((node.child[k] & WideBvh::kLeaf) != 0) ++seen[node.child[k] & ~WideBvh::kLeaf];
    });
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(count));
    // All nodes but those whose children are triangles have four children.
    EXPECT_LE(children, count + count / 2 + 1);
  }
}

TEST(WideBvh, BoundsDistancesFromBelowAndClosely) {
  std::mt19937_64 random(2);
  for (const double offset : {0.0, 1e4}) {
    const Vec3 center{offset, -offset, offset / 3};
    const Boxes boxes(random, 300, center, 10);
    for (int i = 0; i < 200; ++i) {
      Vec3 p = center + scenes::random_vector(random, i % 2 == 0 ? 10 : 1000);
      // On a face of a box, whose distance is no more than rounding.
      if (i % 5 == 0) p = boxes.of_triangles[static_cast<std::size_t>(i)].upper;
      const WideBvh::Distances distances(boxes.wide, p);
      const double rounding = 1e-5 * (20 + length(p - center));
      boxes.for_each_child(boxes.wide.root(), [&](const WideBvh::Node& node, int k, const Aabb& box) {
        float bounds[WideBvh::kWidth];
        EXPECT_EQ(distances.within(node, 3e38f, bounds) >> k & 1u, 1u);
        const double bound = bounds[k], exact = squared_distance(box, p);
        ASSERT_LE(bound, exact);
        ASSERT_GE(std::sqrt(bound), std::sqrt(exact) - rounding);
      });
    }
  }
}

TEST(WideBvh, FindsNoDistanceToMissingChildren) {
  std::mt19937_64 random(3);
  const Boxes boxes(random, 1, {}, 10);
  float bounds[WideBvh::kWidth];
  EXPECT_EQ(WideBvh::Distances(boxes.wide, {1, 2, 3}).within(boxes.wide.root(), 1000, bounds), 1u);
  EXPECT_LT(bounds[0], 1000);
  for (int k = 1; k < WideBvh::kWidth; ++k) EXPECT_EQ(bounds[k], std::numeric_limits<float>::infinity());
  EXPECT_EQ(WideBvh::Ray(boxes.wide, {100, 0, 0}, {-1, 0, 0}).met(boxes.wide.root()) & ~1u, 0u);
}

TEST(WideBvh, FindsEveryBoxThatARayMeetsAndFewOthers) {
  std::mt19937_64 random(4);
  std::size_t met = 0, found = 0;
  for (const double offset : {0.0, 1e4}) {
    const Vec3 center{offset, -offset, offset / 3};
    const Boxes boxes(random, 300, center, 10);
    for (int i = 0; i < 300; ++i) {
      const Vec3 p = center + scenes::random_vector(random, 15);
      // At a corner of a box, along an axis or nearly so, or in any direction.
      Vec3 direction = boxes.of_triangles[static_cast<std::size_t>(i)].upper - p;
      if (i % 3 == 1) direction = {0, i % 2 == 0 ? -1.0 : 2.0, 0};
      if (i % 3 == 2) direction = {1, 1e-9 * (i % 2), 1e-15};
      const WideBvh::Ray ray(boxes.wide, p, direction);
      boxes.for_each_child(boxes.wide.root(), [&](const WideBvh::Node& node, int k, const Aabb& box) {
        const bool is_found = (ray.met(node) >> k & 1u) != 0;
        const bool is_met = meets(box, p, direction);
        ASSERT_TRUE(is_found || !is_met);
        found += is_found;
        met += is_met;
      });
    }
  }
  EXPECT_GT(met, 1000u);
  EXPECT_LT(static_cast<double>(found), 1.02 * static_cast<double>(met) + 300);
}

}  // namespace
}  // namespace dismantle
