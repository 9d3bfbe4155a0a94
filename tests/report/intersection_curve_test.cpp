// SPDX-License-Identifier: Apache-2.0
#include "dismantle/report/intersection_curve.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

double length_of(const std::vector<CurveSegment>& curve) {
  double sum = 0;
  for (const CurveSegment& s : curve) sum += length(s.ends[1] - s.ends[0]);
  return sum;
}

TEST(IntersectionCurve, OfARodThroughAPlateIsTheRodsOutlineOnBothSides) {
  const TriangleMesh plate = scenes::box({-10, -10, -1}, {10, 10, 1});
  const TriangleMesh rod = scenes::moved(scenes::tube(2, 0, -5, 5, 64), {{0.1, 0.2, 0}, {}});
  const std::vector<CurveSegment> curve = intersection_curve(plate, rod);
  EXPECT_NEAR(length_of(curve), 2 * 64 * 2 * 2 * std::sin(std::acos(-1.0) / 64), 1e-9);
  for (const CurveSegment& s : curve)
    for (const Vec3& end : s.ends) EXPECT_NEAR(std::abs(end.z), 1, 1e-12);
}

TEST(IntersectionCurve, IsTheSameLengthInEitherOrder) {
  const TriangleMesh a = scenes::tube(5, 3, 0, 10, 23),
                     b = scenes::moved(scenes::tube(4, 2, -3, 4, 17), {{1, 2, 3}, {}});
  EXPECT_NEAR(length_of(intersection_curve(a, b)), length_of(intersection_curve(b, a)), 1e-9);
  EXPECT_GT(length_of(intersection_curve(a, b)), 1);
}

TEST(IntersectionCurve, IsEmptyForMeshesThatAreApart) {
  EXPECT_TRUE(intersection_curve(scenes::box({0, 0, 0}, {1, 1, 1}), scenes::box({2, 0, 0}, {3, 1, 1})).empty());
  EXPECT_TRUE(intersection_curve(scenes::box({0, 0, 0}, {9, 9, 9}), scenes::box({2, 2, 2}, {3, 3, 3})).empty());
  EXPECT_TRUE(intersection_curve({}, scenes::box({2, 2, 2}, {3, 3, 3})).empty());
}

}  // namespace
}  // namespace dismantle
