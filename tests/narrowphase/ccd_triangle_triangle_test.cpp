// SPDX-License-Identifier: Apache-2.0
#include "dismantle/narrowphase/ccd_triangle_triangle.h"

#include "dismantle/math/screw.h"
#include "tests/narrowphase/triangle_oracle.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <random>

namespace dismantle {
namespace {

const Triangle kFloor{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
const Triangle kUpright{{{1, 1, 0}, {1, 2, 2}, {2, 1, 2}}};

Triangle moved(const Triangle& t, const Pose& pose) {
  const RigidTransform r = transform_from_pose(pose);
  return {{r * t[0], r * t[1], r * t[2]}};
}

Triangle shifted(const Triangle& t, Vec3 by) {
  return {{t[0] + by, t[1] + by, t[2] + by}};
}

TriangleMotion still(const Triangle& t) {
  return {t, t};
}

TriangleMotion moving(const Triangle& t, Vec3 from, Vec3 to) {
  return {shifted(t, from), shifted(t, to)};
}

bool free(const TriangleMotion& a, const TriangleMotion& b, double allowed) {
  return ccd_triangle_triangle(a, b, allowed).status == CcdStatus::Free;
}

//   upright   \/   falls to one unit below the floor: contact at time 1/2, depth 1/4 at time 5/8
//   floor   ------
TEST(CcdTriangleTriangle, StopsAtTheTimeOfContactOrOfTheAllowedDepth) {
  const TriangleMotion falling = moving(kUpright, {0, 0, 1}, {0, 0, -1});
  const CcdResult touching = ccd_triangle_triangle(still(kFloor), falling, 0);
  EXPECT_EQ(touching.status, CcdStatus::Contact);
  EXPECT_LE(touching.toi, 0.5);
  EXPECT_NEAR(touching.toi, 0.5, 1e-7);
  const CcdResult deep = ccd_triangle_triangle(still(kFloor), falling, 0.25);
  EXPECT_EQ(deep.status, CcdStatus::Contact);
  EXPECT_LE(deep.toi, 0.625);
  EXPECT_NEAR(deep.toi, 0.625, 1e-7);
}

TEST(CcdTriangleTriangle, LetsAMissPass) {
  EXPECT_TRUE(free(still(kFloor), moving(kUpright, {4, 0, 1}, {4, 0, -4}), 0));
  EXPECT_TRUE(free(still(kFloor), moving(kUpright, {0, 0, 1}, {0, 0, 0.001}), 0));
  EXPECT_TRUE(free(still(kFloor), moving(kUpright, {-9, 0, 1}, {9, 0, 1}), 0));
}

TEST(CcdTriangleTriangle, CallsTouchingContactOnlyWithoutAnAllowance) {
  const TriangleMotion landing = moving(kUpright, {0, 0, 1}, {0, 0, 0});
  EXPECT_FALSE(free(still(kFloor), landing, 0));
  EXPECT_TRUE(free(still(kFloor), landing, 1e-6));
}

TEST(CcdTriangleTriangle, IsContactAtOnceIfTheTrianglesAreTooDeepAtTheStart) {
  const TriangleMotion leaving = moving(kUpright, {0, 0, -1}, {0, 0, 1});
  const CcdResult r = ccd_triangle_triangle(still(kFloor), leaving, 0.5);
  EXPECT_EQ(r.status, CcdStatus::Contact);
  EXPECT_EQ(r.toi, 0);
}

TEST(CcdTriangleTriangle, LetsTouchingFacesSlideOnEachOther) {
  EXPECT_TRUE(free(still(kFloor), moving(kFloor, {0, 0, 0}, {1, 2, 0}), 0.01));
  EXPECT_TRUE(free(still(kFloor), moving(kFloor, {-1, 0, 0}, {1, 1, 0}), 0.01));
  EXPECT_FALSE(free(still(kFloor), moving(kFloor, {0, 0, 0}, {1, 2, 0}), 0));
}

TEST(CcdTriangleTriangle, LetsTouchingTrianglesMoveApart) {
  EXPECT_TRUE(free(still(kFloor), moving(kFloor, {0, 0, 0}, {0, 0, 5}), 0.01));
  EXPECT_TRUE(free(still(kFloor), moving(kFloor, {0, 0, 0}, {0, 0, -5}), 0.01));
  EXPECT_TRUE(free(still(kFloor), moving(kUpright, {0, 0, 0}, {1, 1, 5}), 0.01));
  EXPECT_TRUE(free(still(kFloor), moving(kUpright, {0, 0, -0.005}, {0, 0, 5}), 0.01));
}

TEST(CcdTriangleTriangle, RemembersTheSideOfOpenSheetsByTheAxisThatItIsGiven) {
  // Two parallel triangles have no thickness, so they stay within the allowance while they pass through each other; the
  // axis of the preceding motion tells their sides.
  const double allowed = 0.01;
  const AxisCcdResult landed =
      ccd_triangle_triangle(still(kFloor), moving(kFloor, {0, 0, 1}, {0, 0, -0.005}), allowed, {});
  ASSERT_EQ(landed.ccd.status, CcdStatus::Free);
  EXPECT_GT(landed.axis.z, 0);
  const TriangleMotion through = moving(kFloor, {0, 0, -0.005}, {0, 0, -1});
  const AxisCcdResult pressed = ccd_triangle_triangle(still(kFloor), through, allowed, landed.axis);
  EXPECT_EQ(pressed.ccd.status, CcdStatus::Contact);
  EXPECT_LE(pressed.ccd.toi, 0.0051);
  // In one motion the side is that of the start.
  EXPECT_FALSE(free(still(kFloor), moving(kFloor, {0, 0, 1}, {0, 0, -1}), allowed));
  // Off the edge and back below goes around, not through.
  const TriangleMotion aside = moving(kFloor, {0, 0, -0.005}, {-4.5, 0, -0.005});
  const AxisCcdResult left = ccd_triangle_triangle(still(kFloor), aside, allowed, landed.axis);
  ASSERT_EQ(left.ccd.status, CcdStatus::Free);
}

TEST(CcdTriangleTriangle, DecidesWithTheGivenAxisIfItStillSeparates) {
  const TriangleMotion first = moving(kUpright, {0.3, 0.2, 1}, {0, 0, 0.9}),
                       second = moving(kUpright, {0, 0, 0.9}, {0.1, 0, 0.8});
  const AxisCcdResult before = ccd_triangle_triangle(still(kFloor), first, 0, {});
  ASSERT_EQ(before.ccd.status, CcdStatus::Free);
  const AxisCcdResult after = ccd_triangle_triangle(still(kFloor), second, 0, before.axis);
  EXPECT_EQ(after.ccd.status, CcdStatus::Free);
  EXPECT_EQ(after.ccd.iterations, 0);
}

TEST(CcdTriangleTriangle, BoundsTrianglesWithoutArea) {
  const Triangle needle{{{1, 1, 0}, {1, 1, 1}, {1, 1, 2}}}, point{{{1, 1, 0}, {1, 1, 0}, {1, 1, 0}}};
  for (const Triangle& t : {needle, point}) {
    EXPECT_FALSE(free(still(kFloor), moving(t, {0, 0, 1}, {0, 0, -1}), 0));
    EXPECT_TRUE(free(still(kFloor), moving(t, {0, 0, 1}, {0, 0, 0.1}), 0));
    EXPECT_TRUE(free(still(kFloor), moving(t, {3, 3, 1}, {3, 3, -3}), 0));
    EXPECT_TRUE(free(moving(t, {0, 0, 1}, {0, 0, 0}), still(t), 1e-3));
    EXPECT_FALSE(free(moving(t, {1, 0, 0}, {0, 0, 0}), still(t), 0));
  }
}

/// Random triangle motions: sizes and distances log-uniform, translations and chords of rotations.
class RandomMotions {
 public:
  explicit RandomMotions(unsigned seed) : random_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  Vec3 direction() {
    for (;;) {
      const Vec3 v{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
      if (length(v) > 0.1 && length(v) < 1) return normalized(v);
    }
  }
  double log_uniform(double low, double high) { return std::pow(10, uniform(low, high)); }

  Triangle triangle() {
    const double size = log_uniform(-1, 1);
    Triangle t;
    for (Vec3& c : t.corner) c = size * uniform(0.3, 1) * direction();
    if (uniform(0, 1) < 0.2) t[2] = t[0] + uniform(0, 1) * (t[1] - t[0]) + log_uniform(-9, -3) * direction();
    return t;
  }

  /// Motions of a triangle that start near `place`.
  TriangleMotion motion(Vec3 place) {
    const Triangle t = shifted(triangle(), place);
    const Vec3 displacement = log_uniform(-3, 0.5) * direction();
    const double turn = uniform(0, 1) < 0.5 ? 0 : log_uniform(-4, 0);
    return {t, moved(t, {displacement, quat_about(direction(), turn)})};
  }

 private:
  std::mt19937_64 random_;
};

TEST(CcdTriangleTriangle, NeverPassesMoreThanTheAllowedDepthAgainstDenseSampling) {
  constexpr unsigned kSeed = 42;
  RandomMotions random(kSeed);
  int free_pairs = 0, stopped = 0, unsettled = 0;
  for (int k = 0; k < 12000; ++k) {
    const TriangleMotion a = random.motion({}), b = random.motion(random.log_uniform(-4, 0.3) * random.direction());
    const double allowed = k % 3 == 0 ? 0 : random.log_uniform(-4, -0.5);
    const CcdResult r = ccd_triangle_triangle(a, b, allowed);
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << " pair " << k << " allowed " << allowed << " toi " << r.toi);
    const oracle::Real stopping_gap = oracle::best_gap(oracle::at(a, r.toi), oracle::at(b, r.toi));
    if (r.status == CcdStatus::Contact && r.toi == 0) {
      ASSERT_LE(stopping_gap, -allowed + 1e-5L) << "the motion could have started";
      continue;
    }
    // Coordinates stay below 20: the samples round by less than 1e-15.
    const oracle::Deepest d = oracle::deepest(a, b, r.toi, 60);
    ASSERT_LE(d.depth, allowed + 1e-15L) << "at " << static_cast<double>(d.time);

    if (r.status == CcdStatus::Free) {
      ++free_pairs;
    } else if (r.iterations == AdvancementLimits{}.steps) {
      ++unsettled;
    } else {
      ++stopped;
      ASSERT_LE(stopping_gap, allowed + 1e-5L) << "a false positive away from contact";
    }
  }
  std::printf("seed %u: %d free, %d stopped, %d not settled\n", kSeed, free_pairs, stopped, unsettled);
  EXPECT_GT(free_pairs, 1000);
  EXPECT_GT(stopped, 500);
  EXPECT_LE(unsettled, 12);
}

TEST(CcdTriangleTriangle, IsTheSameWithTheTrianglesExchanged) {
  constexpr unsigned kSeed = 43;
  RandomMotions random(kSeed);
  int other_way = 0;
  for (int k = 0; k < 4000; ++k) {
    const TriangleMotion a = random.motion({}), b = random.motion(random.log_uniform(-2, 0.3) * random.direction());
    const double allowed = k % 2 == 0 ? 0 : 0.01;
    const CcdResult ab = ccd_triangle_triangle(a, b, allowed), ba = ccd_triangle_triangle(b, a, allowed);
    if (ab.status == ba.status && std::abs(ab.toi - ba.toi) < 1e-4) continue;
    // Within the allowance, the side of a thin triangle depends on the axis that is tested first.
    ASSERT_GT(allowed, 0) << "seed " << kSeed << " pair " << k;
    ++other_way;
  }
  EXPECT_LE(other_way, 8);
}

/// The first contact of any triangle pair of two meshes, b moving by `displacement`.
CcdResult sweep(const TriangleMesh& a, const TriangleMesh& b, Vec3 displacement, double allowed) {
  CcdResult first;
  for (std::size_t i = 0; i < a.faces.size(); ++i)
    for (std::size_t j = 0; j < b.faces.size(); ++j) {
      const CcdResult r = ccd_triangle_triangle(still(a.triangle(i)), moving(b.triangle(j), {}, displacement), allowed);
      if (r.status == CcdStatus::Contact && r.toi <= first.toi) first = r;
    }
  return first;
}

TEST(CcdTriangleTriangle, LetsNoBoxTunnelThroughAPlate) {
  const TriangleMesh plate = scenes::box({-5, -5, -0.05}, {5, 5, 0.05});
  for (const double gap : {0.0, 1e-9, 0.1, 3.0}) {
    const TriangleMesh box = scenes::box({-1, -1, 0.05 + gap}, {1, 1, 2.05 + gap});
    for (const double far : {1.0, 10.0, 1e4}) {
      const CcdResult down = sweep(plate, box, {0, 0, -gap - far}, 0.01);
      EXPECT_EQ(down.status, CcdStatus::Contact) << gap << " " << far;
      EXPECT_LE(down.toi * (gap + far), gap + 0.01 + 1e-9);
      EXPECT_GE(down.toi * (gap + far), gap + 0.0099);
      EXPECT_EQ(sweep(plate, box, {0, 0, far}, 0.01).status, CcdStatus::Free) << gap << " " << far;
      EXPECT_EQ(sweep(plate, box, {far, 0.3 * far, 0}, 0.01).status, CcdStatus::Free) << gap << " " << far;
    }
  }
}

}  // namespace
}  // namespace dismantle
