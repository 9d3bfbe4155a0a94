// SPDX-License-Identifier: Apache-2.0
#include "dismantle/narrowphase/penetration_triangle_triangle.h"
#include "tests/support/check_triangle_pair.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dismantle {
namespace {

const Triangle kFace{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};

TEST(PenetrationTriangleTriangle, IsTheDepthOfACornerUnderTheFace) {
  const Triangle dips{{{1, 1, -0.25}, {1, 1, 9}, {2, 1, 9}}};
  const Penetration p = penetration_triangle_triangle(kFace, dips);
  EXPECT_EQ(p.depth, 0.25);
  EXPECT_EQ(p.axis, (Vec3{0, 0, 1}));
  const Penetration back = penetration_triangle_triangle(dips, kFace);
  EXPECT_EQ(back.depth, 0.25);
  EXPECT_EQ(back.axis, (Vec3{0, 0, -1}));
}

TEST(PenetrationTriangleTriangle, LeavesSidewaysOverAnEdgeIfThatIsShorter) {
  const Triangle wall{{{0.125, 2, -9}, {0.125, 2, 9}, {-9, 2, 9}}};
  const Penetration p = penetration_triangle_triangle(kFace, wall);
  EXPECT_NEAR(p.depth, 0.125, 1e-15);
  EXPECT_NEAR(p.axis.x, -1, 1e-15);
}

TEST(PenetrationTriangleTriangle, IsZeroIfApartTouchingOrCoplanar) {
  EXPECT_EQ(penetration_triangle_triangle(kFace, {{{1, 1, 1}, {1, 1, 2}, {2, 1, 1}}}).depth, 0);
  EXPECT_EQ(penetration_triangle_triangle(kFace, {{{1, 1, 0}, {1, 1, 2}, {2, 1, 1}}}).depth, 0);
  EXPECT_EQ(penetration_triangle_triangle(kFace, kFace).depth, 0);
  EXPECT_EQ(penetration_triangle_triangle(kFace, {{{1, 1, 0}, {9, 1, 0}, {1, 9, 0}}}).depth, 0);
  const Triangle tilted{{{0.1, 0.2, 0.3}, {1.1, 2.2, 3.3}, {-0.7, 0.9, 0.31}}};
  EXPECT_EQ(penetration_triangle_triangle(tilted, tilted).depth, 0);
}

TEST(PenetrationTriangleTriangle, OfASegmentThroughAFaceIsThatOfItsEnd) {
  const Penetration p = penetration_triangle_triangle(kFace, {{{1, 1, -0.25}, {1, 1, 9}, {1, 1, 9}}});
  EXPECT_EQ(p.depth, 0.25);
  EXPECT_EQ(
      penetration_triangle_triangle({{{0, 0, 0}, {2, 2, 2}, {2, 2, 2}}}, {{{2, 0, 1}, {0, 2, 1}, {1, 1, 1}}}).depth, 0);
}

TEST(PenetrationTriangleTriangle, KeepsItsAccuracyForNearlyParallelEdges) {
  for (int k = 0; k <= 100; ++k) {
    const double tilt = std::ldexp(1, -k);
    const Triangle a{{{-1, 0, 0.3}, {1, 0, 0.3}, {0.1, -0.7, -9}}};
    const Triangle b{{{-1, -tilt, 0.1}, {1, tilt, 0.1}, {0, -0.6, 9}}};
    const scenes::PairCheck check = scenes::check_pair({a, b});
    EXPECT_EQ(check.meeting, 1);
    EXPECT_TRUE(check.passed()) << "tilt 2^-" << k << ": " << check.worst_depth_error;
  }
}

TEST(PenetrationTriangleTriangle, ScalesWithItsInput) {
  const Triangle a{{{0.1, 0.2, 0.3}, {1.1, 0.4, 0.5}, {0.3, 1.2, 0.1}}};
  const Triangle b{{{0.4, 0.5, -0.3}, {0.6, 0.5, 1.2}, {0.2, 0.9, 1.1}}};
  const double depth = penetration_triangle_triangle(a, b).depth;
  ASSERT_GT(depth, 0.01);
  for (const int exponent : {-460, -200, -20, 20, 200, 460}) {
    const double s = std::ldexp(1, exponent);
    const Triangle sa{{s * a[0], s * a[1], s * a[2]}}, sb{{s * b[0], s * b[1], s * b[2]}};
    EXPECT_NEAR(penetration_triangle_triangle(sa, sb).depth / s, depth, 1e-15) << exponent;
  }
}

}  // namespace
}  // namespace dismantle
