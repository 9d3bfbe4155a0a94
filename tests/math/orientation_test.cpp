// SPDX-License-Identifier: Apache-2.0
#include "dismantle/math/orientation.h"
#include "tests/support/exact_triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace dismantle {
namespace {

constexpr std::uint64_t kSeed = 20240613;

class Points {
 public:
  explicit Points(int largest_exponent) : exponent_(-largest_exponent, largest_exponent) {}
  double coordinate() {
    const double m = mantissa_(random_);
    return std::ldexp(m, exponent_(random_));
  }
  Vec3 point() {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    return {x, y, z};
  }
  double fraction() { return mantissa_(random_); }

 private:
  std::mt19937_64 random_{kSeed};
  std::uniform_int_distribution<int> exponent_;
  std::uniform_real_distribution<double> mantissa_{-1, 1};
};

/// The exact sign in two dimensions: that in three with a point above the plane.
int exact_orient2d(Vec2 a, Vec2 b, Vec2 c) {
  return exact::orient3d_sign({a.x, a.y, 0}, {b.x, b.y, 0}, {c.x, c.y, 0}, {a.x, a.y, 1});
}

TEST(Orientation, OfTheUnitCornersIsPositive) {
  EXPECT_EQ(orient2d_sign({0, 0}, {1, 0}, {0, 1}), 1);
  EXPECT_EQ(orient2d_sign({0, 0}, {0, 1}, {1, 0}), -1);
  EXPECT_EQ(orient3d_sign({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
  EXPECT_EQ(orient3d_sign({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}), -1);
  EXPECT_EQ(orient3d_sign({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {7, -3, 0}), 0);
}

TEST(Orientation, IsExactForCoordinatesOfDifferentMagnitudes) {
  for (const int exponent : {3, 60, 332, 600, 1020}) {  // 332: from 1e-100 to 1e100.
    Points points(exponent);
    for (int i = 0; i < 3000; ++i) {
      const Vec3 a = points.point(), b = points.point(), c = points.point(), d = points.point();
      ASSERT_EQ(orient3d_sign(a, b, c, d), exact::orient3d_sign(a, b, c, d)) << "seed " << kSeed << " pair " << i;
      ASSERT_EQ(orient2d_sign({a.x, a.y}, {b.x, b.y}, {c.x, c.y}), exact_orient2d({a.x, a.y}, {b.x, b.y}, {c.x, c.y}));
    }
  }
}

TEST(Orientation, IsExactNearThePlaneAtEveryMagnitude) {
  for (const int exponent : {0, 20, 332, 1000}) {
    Points points(exponent);
    int zeros = 0, decided = 0;
    for (int i = 0; i < 3000; ++i) {
      const double scale = std::fabs(points.coordinate());
      const Vec3 a = scale * points.point(), b = points.fraction() * a + scale * Vec3{points.fraction(), 0, 0.5};
      const Vec3 c = a + scale * Vec3{points.fraction(), points.fraction(), points.fraction()};
      Vec3 d = a + points.fraction() * (b - a) + points.fraction() * (c - a);
      if (i % 2 == 0) d.y = std::nextafter(d.y, 2 * d.y);
      if (!is_finite(a) || !is_finite(b) || !is_finite(c) || !is_finite(d)) continue;
      const int sign = orient3d_sign(a, b, c, d);
      ASSERT_EQ(sign, exact::orient3d_sign(a, b, c, d)) << "seed " << kSeed << " pair " << i;
      ASSERT_EQ(orient3d_sign(b, a, c, d), -sign);
      ASSERT_EQ(orient3d_sign(a, b, d, c), -sign);
      const Vec2 p{a.x, a.y}, q{b.x, b.y}, on{a.x + 0.3 * (b.x - a.x), a.y + 0.3 * (b.y - a.y)};
      ASSERT_EQ(orient2d_sign(p, q, on), exact_orient2d(p, q, on));
      ++(sign == 0 ? zeros : decided);
    }
    EXPECT_GT(decided, 100);
  }
}

TEST(Orientation, OfPointsExactlyInOnePlaneIsZero) {
  Points points(0);
  for (int i = 0; i < 3000; ++i) {
    const auto whole = [&points] { return std::floor(1e6 * points.fraction()); };
    const Vec3 origin{whole(), whole(), whole()}, u{whole(), whole(), whole()}, v{whole(), whole(), whole()};
    const auto at = [&](double s, double t) { return 0x1p-20 * (origin + s * u + t * v); };
    ASSERT_EQ(orient3d_sign(at(0, 1), at(3, -2), at(5, 7), at(-4, 11)), 0);
    const Vec3 p = at(0, 1), q = at(1, 2), r = at(-2, -1);
    ASSERT_EQ(orient2d_sign({p.x, p.y}, {q.x, q.y}, {r.x, r.y}), 0);
  }
}

TEST(Orientation, IsExactAtTheEndsOfTheRangeOfDoubles) {
  const double huge = std::numeric_limits<double>::max(), tiny = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(orient3d_sign({-huge, -huge, -huge}, {huge, 0, 0}, {0, huge, 0}, {0, 0, huge}),
            exact::orient3d_sign({-huge, -huge, -huge}, {huge, 0, 0}, {0, huge, 0}, {0, 0, huge}));
  EXPECT_EQ(orient3d_sign({0, 0, 0}, {tiny, 0, 0}, {0, tiny, 0}, {0, 0, tiny}), 1);
  EXPECT_EQ(orient3d_sign({0, 0, 0}, {huge, 0, 0}, {0, huge, 0}, {huge, huge, -tiny}), -1);
  EXPECT_EQ(orient2d_sign({0, 0}, {tiny, 0}, {0, tiny}), 1);
  EXPECT_EQ(orient2d_sign({-huge, -huge}, {huge, huge}, {0, tiny}), 1);
  EXPECT_EQ(orient2d_sign({-huge, -huge}, {huge, huge}, {0, 0}), 0);
}

}  // namespace
}  // namespace dismantle
