// SPDX-License-Identifier: Apache-2.0
#include "dismantle/narrowphase/intersect_triangle_triangle.h"
#include "tests/support/check_triangle_pair.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

const Triangle kFace{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};

Triangle segment(Vec3 p, Vec3 q) {
  return {{p, q, p}};
}
Triangle point(Vec3 p) {
  return {{p, p, p}};
}

TriangleRelation relation(const Triangle& t) {
  const TriangleRelation forward = relation_triangle_triangle(kFace, t);
  EXPECT_EQ(relation_triangle_triangle(t, kFace), forward);
  return forward;
}

TEST(IntersectTriangleTriangle, TellsCrossingFromApart) {
  EXPECT_EQ(relation({{{1, 1, -1}, {1, 1, 1}, {2, 1, 1}}}), TriangleRelation::Crossing);
  EXPECT_EQ(relation({{{1, 1, 1}, {1, 1, 2}, {2, 1, 1}}}), TriangleRelation::Apart);
  EXPECT_EQ(relation({{{5, 5, -1}, {5, 5, 1}, {6, 5, 1}}}), TriangleRelation::Apart);
}

TEST(IntersectTriangleTriangle, CountsTouchingAtACornerAnEdgeAndTheFace) {
  EXPECT_EQ(relation({{{0, 0, 0}, {-1, 0, 1}, {-1, 1, 2}}}), TriangleRelation::Crossing);   // corner on corner
  EXPECT_EQ(relation({{{2, 2, 0}, {3, 3, 1}, {3, 4, 2}}}), TriangleRelation::Crossing);     // corner on edge
  EXPECT_EQ(relation({{{1, 1, 0}, {1, 1, 1}, {1, 2, 1}}}), TriangleRelation::Crossing);     // corner on face
  EXPECT_EQ(relation({{{2, -1, -1}, {2, 1, 1}, {9, -9, 3}}}), TriangleRelation::Crossing);  // edge on edge
  EXPECT_EQ(relation({{{1, 1, 0}, {9, 9, 0}, {9, 9, 1}}}), TriangleRelation::Crossing);     // edge in the plane
  EXPECT_EQ(relation({{{3, 3, 0}, {9, 9, 0}, {9, 9, 1}}}), TriangleRelation::Apart);
}

TEST(IntersectTriangleTriangle, DecidesCoplanarTriangles) {
  EXPECT_EQ(relation(kFace), TriangleRelation::Flat);
  EXPECT_EQ(relation({{{0.5, 0.5, 0}, {1, 0.5, 0}, {0.5, 1, 0}}}), TriangleRelation::Flat);  // inside
  EXPECT_EQ(relation({{{-9, -9, 0}, {20, -9, 0}, {-9, 20, 0}}}), TriangleRelation::Flat);    // around
  EXPECT_EQ(relation({{{4, 0, 0}, {5, 0, 0}, {4, 1, 0}}}), TriangleRelation::Flat);          // corner on corner
  EXPECT_EQ(relation({{{2, 2, 0}, {5, 0, 0}, {5, 5, 0}}}), TriangleRelation::Flat);          // corner on edge
  EXPECT_EQ(relation({{{4, 4, 0}, {5, 0, 0}, {5, 5, 0}}}), TriangleRelation::Apart);         // boxes meet
  EXPECT_EQ(relation({{{2, 2.0000000001, 0}, {5, 0, 0}, {5, 5, 0}}}), TriangleRelation::Apart);
  EXPECT_EQ(relation({{{1, -2, 0}, {2, -2, 0}, {1, 9, 0}}}), TriangleRelation::Flat);  // a spike across
}

TEST(IntersectTriangleTriangle, TakesTrianglesWithoutAreaAsSegmentsAndPoints) {
  EXPECT_EQ(relation(segment({1, 1, -1}, {1, 1, 1})), TriangleRelation::Flat);
  EXPECT_EQ(relation(segment({3, 3, -1}, {3, 3, 1})), TriangleRelation::Apart);
  EXPECT_EQ(relation(segment({1, 1, 1}, {1, 1, 2})), TriangleRelation::Apart);
  EXPECT_EQ(relation(segment({-1, -1, 0}, {9, 9, 0})), TriangleRelation::Flat);
  EXPECT_EQ(relation(segment({-1, 4, 0}, {-1, -9, 0})), TriangleRelation::Apart);
  EXPECT_EQ(relation(point({1, 1, 0})), TriangleRelation::Flat);
  EXPECT_EQ(relation(point({2, 2, 0})), TriangleRelation::Flat);
  EXPECT_EQ(relation(point({2, 2, 1e-300})), TriangleRelation::Apart);
  EXPECT_EQ(relation({{{1, 1, -1}, {1, 1, 3}, {1, 1, 1}}}), TriangleRelation::Flat);
}

TEST(IntersectTriangleTriangle, DecidesTwoTrianglesWithoutArea) {
  const Triangle s = segment({0, 0, 0}, {2, 2, 2});
  EXPECT_TRUE(intersect_triangle_triangle(s, segment({2, 0, 1}, {0, 2, 1})));
  EXPECT_FALSE(intersect_triangle_triangle(s, segment({2, 0, 1.5}, {0, 2, 1.5})));
  EXPECT_TRUE(intersect_triangle_triangle(s, segment({1, 1, 1}, {3, 3, 3})));
  EXPECT_FALSE(intersect_triangle_triangle(s, segment({3, 3, 3}, {4, 4, 4})));
  EXPECT_FALSE(intersect_triangle_triangle(s, segment({0, 0, 1}, {2, 2, 3})));
  EXPECT_TRUE(intersect_triangle_triangle(s, point({1, 1, 1})));
  EXPECT_FALSE(intersect_triangle_triangle(s, point({1, 1, 1.5})));
  EXPECT_FALSE(intersect_triangle_triangle(s, point({3, 3, 3})));
  EXPECT_TRUE(intersect_triangle_triangle(point({1, 2, 3}), point({1, 2, 3})));
  EXPECT_FALSE(intersect_triangle_triangle(point({1, 2, 3}), point({1, 2, 4})));
}

/// The checks of `soak_triangle_pairs` on fewer pairs.
TEST(IntersectTriangleTriangle, AgreesWithExactArithmeticOnEveryFamilyOfPairs) {
  constexpr std::uint64_t kSeed = 20240614;
  scenes::TrianglePairs pairs(kSeed);
  constexpr int kKinds = static_cast<int>(scenes::PairKind::kCount);
  scenes::PairCheck total;
  for (int i = 0; i < 20400; ++i) {
    const auto kind = static_cast<scenes::PairKind>(i % kKinds);
    const scenes::PairCheck check = scenes::check_pair(pairs.next(kind));
    ASSERT_TRUE(check.passed()) << scenes::name_of(kind) << ", seed " << kSeed << ", pair " << i;
    total.add(check);
  }
  EXPECT_GT(total.meeting, 5000);
  EXPECT_GT(total.pairs - total.meeting, 5000);
}

}  // namespace
}  // namespace dismantle
