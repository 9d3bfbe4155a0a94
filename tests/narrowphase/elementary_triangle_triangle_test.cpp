// SPDX-License-Identifier: Apache-2.0
#include "dismantle/narrowphase/elementary_triangle_triangle.h"

#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dismantle {
namespace {

const Triangle kFloor{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
const Triangle kUpright{{{1, 1, 0}, {1, 2, 2}, {2, 1, 2}}};

Triangle shifted(const Triangle& t, Vec3 by) {
  return {{t[0] + by, t[1] + by, t[2] + by}};
}

TriangleMotion moving(const Triangle& t, Vec3 from, Vec3 to) {
  return {shifted(t, from), shifted(t, to)};
}

TEST(ElementaryTriangleTriangle, FindsTheCornerThatFallsOnTheFace) {
  const ElementaryTriangle floor{moving(kFloor, {}, {})};
  const ElementaryTriangle upright{moving(kUpright, {0, 0, 1}, {0, 0, -1})};
  const ElementaryPairResult r = elementary_triangle_triangle(floor, upright);
  EXPECT_EQ(r.ccd.status, CcdStatus::Contact);
  EXPECT_NEAR(r.ccd.toi, 0.5, 1e-15);
  EXPECT_EQ(r.filtered + r.elementary_tests, 15);
  EXPECT_GE(r.elementary_tests, 1);
}

TEST(ElementaryTriangleTriangle, IsTheSameWithTheTrianglesExchanged) {
  const ElementaryTriangle floor{moving(kFloor, {}, {0, 0, 0.25})};
  const ElementaryTriangle upright{moving(kUpright, {1.5, 1, 1}, {0, 0, -1})};
  const ElementaryPairResult ab = elementary_triangle_triangle(floor, upright);
  const ElementaryPairResult ba = elementary_triangle_triangle(upright, floor);
  EXPECT_EQ(ab.ccd.status, CcdStatus::Contact);
  EXPECT_EQ(ba.ccd.status, CcdStatus::Contact);
  EXPECT_NEAR(ab.ccd.toi, ba.ccd.toi, 1e-14);
  EXPECT_EQ(ab.elementary_tests, ba.elementary_tests);
}

TEST(ElementaryTriangleTriangle, TestsOnlyTheFeaturesThatTheTrianglesStandFor) {
  const TriangleMotion still = moving(kFloor, {}, {}), falling = moving(kUpright, {0, 0, 1}, {0, 0, -1});
  const auto with = [&](unsigned floor, unsigned upright) {
    return elementary_triangle_triangle({still, static_cast<std::uint8_t>(floor)},
                                        {falling, static_cast<std::uint8_t>(upright)});
  };
  EXPECT_EQ(with(0, 0).filtered + with(0, 0).elementary_tests, 0);
  EXPECT_EQ(with(0, 0).ccd.status, CcdStatus::Free);
  EXPECT_EQ(with(0, 1).ccd.status, CcdStatus::Contact) << "corner 0 of the upright triangle is the one that falls";
  EXPECT_EQ(with(0, 2).ccd.status, CcdStatus::Free);
  EXPECT_EQ(with(0, 4).ccd.status, CcdStatus::Free);
  const ElementaryPairResult edges = with(0x38, 0x08);
  EXPECT_EQ(edges.filtered + edges.elementary_tests, 3);
}

TEST(ElementaryTriangleTriangle, FindsCrossingEdgesIfNoCornerMeetsAFace) {
  const Triangle blade{{{2, -3, -1}, {2, -3, 1}, {2, -1, 0}}};
  const Triangle bar{{{0, -9, -0.5}, {4, -9, 0}, {0, -9, 0.5}}};
  const TriangleMotion still{blade, blade};
  const TriangleMotion coming = moving(bar, {0, 0, 0}, {0, 7, 0});
  const ElementaryPairResult r = elementary_triangle_triangle({still}, {coming});
  EXPECT_EQ(r.ccd.status, CcdStatus::Contact);
  const ElementaryPairResult corners = elementary_triangle_triangle({still, 0x07}, {coming, 0x07});
  EXPECT_EQ(corners.ccd.status, CcdStatus::Free);
}

TEST(ElementaryTriangleTriangle, NoticesFacesThatSlideOverEachOtherInOnePlane) {
  const ElementaryTriangle still{moving(kFloor, {}, {})};
  const ElementaryTriangle sliding{moving(kFloor, {-6, 0, 0}, {-2, 0, 0})};
  const ElementaryPairResult r = elementary_triangle_triangle(still, sliding);
  EXPECT_EQ(r.ccd.status, CcdStatus::Contact);
  EXPECT_NEAR(r.ccd.toi, 0.5, 1e-14);
}

TEST(ElementaryApart, HoldsForAFaceThatSlidesOverAnotherAndNotForOneThatTouchesIt) {
  const TriangleMotion still = moving(kFloor, {}, {});
  EXPECT_TRUE(elementary_apart(still, moving(kFloor, {-6, 0, 0.01}, {-2, 0, 0.01})));
  EXPECT_TRUE(elementary_apart(moving(kFloor, {-6, 0, -0.01}, {-2, 0, -0.01}), still));
  EXPECT_FALSE(elementary_apart(still, moving(kFloor, {-6, 0, 0}, {-2, 0, 0})));
  EXPECT_FALSE(elementary_apart(still, moving(kUpright, {0, 0, 1}, {0, 0, -1})));
}

// Parallel faces at gaps from far below to far above the touching threshold of the elementary tests, in any pose: if
// the axis separates them, no feature may be reported.
TEST(ElementaryApart, NeverHoldsIfAnElementaryTestReportsAContact) {
  const unsigned seed = 11;
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> exponent(-14, 0), turn(-1e-3, 1e-3);
  int apart = 0, contacts = 0;
  for (int trial = 0; trial < 30'000; ++trial) {
    const double far = trial % 3 == 0 ? 0 : (trial % 3 == 1 ? 1e3 : 1e7), gap = std::pow(10, exponent(random));
    const Pose place = Pose{scenes::random_vector(random, far), {}} * scenes::random_pose(random, 1, 3);
    const auto placed = [&](const Triangle& t, const Pose& by) {
      const RigidTransform world = transform_from_pose(place * by);
      return Triangle{{world * t[0], world * t[1], world * t[2]}};
    };
    const Vec3 slide = scenes::random_vector(random, 1);
    const Pose over{{slide.x, slide.y, gap}, quat_about({0, 0, 1}, slide.z)};
    const Pose after{{slide.y, slide.z, gap * (trial % 2 == 0 ? 1.0 : 3.0)}, quat_about({0, 0, 1}, turn(random))};
    const TriangleMotion still{placed(kFloor, {}), placed(kFloor, {})};
    const TriangleMotion sliding{placed(kFloor, over), placed(kFloor, after)};
    const bool reported = elementary_triangle_triangle({still}, {sliding}).ccd.status == CcdStatus::Contact;
    const bool certain = elementary_apart(still, sliding);
    ASSERT_FALSE(reported && certain) << trial << ": " << gap;
    apart += certain ? 1 : 0;
    contacts += reported ? 1 : 0;
  }
  EXPECT_GT(apart, 10'000);
  EXPECT_GT(contacts, 3'000);
}

}  // namespace
}  // namespace dismantle
