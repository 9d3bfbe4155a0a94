// SPDX-License-Identifier: Apache-2.0
#include "dismantle/narrowphase/separating_axis.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>

namespace dismantle {
namespace {

using Exact = boost::multiprecision::cpp_rational;

template <int kA, int kB>
struct Points {
  Vec3 a[2][kA], b[2][kB];
};

Exact exact_dot(Vec3 w, Vec3 p) {
  return Exact(w.x) * Exact(p.x) + Exact(w.y) * Exact(p.y) + Exact(w.z) * Exact(p.z);
}

/// The exact projected gap at time s of the given positions.
template <int kA, int kB>
Exact exact_gap(const Points<kA, kB>& p, Vec3 w, const Exact& s) {
  bool first = true;
  Exact gap;
  for (int i = 0; i < kA; ++i)
    for (int j = 0; j < kB; ++j) {
      const Exact start = exact_dot(w, p.b[0][j]) - exact_dot(w, p.a[0][i]);
      const Exact finish = exact_dot(w, p.b[1][j]) - exact_dot(w, p.a[1][i]);
      const Exact here = start + s * (finish - start);
      if (first || here < gap) gap = here;
      first = false;
    }
  return gap;
}

/// gap > -allowed * |w|, exactly.
bool exactly_separated(const Exact& gap, Vec3 w, double allowed) {
  const Exact reach = Exact(allowed) * Exact(allowed) * exact_dot(w, w);
  if (allowed >= 0) return gap > 0 || (gap * gap < reach);
  return gap > 0 && gap * gap > reach;
}

/// Hulls whose gap along the axis differs from `-allowed` by log-uniform amounts down to rounding errors.
class NearlyTouching {
 public:
  explicit NearlyTouching(unsigned seed) : random_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  Vec3 vector() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; }
  double tiny() { return (uniform(0, 1) < 0.5 ? -1 : 1) * std::pow(10, uniform(-18, -1)); }

  template <int kA, int kB>
  Points<kA, kB> points(Vec3 w, double allowed) {
    const double size = std::pow(10, uniform(-3, 3));
    const Vec3 offset = uniform(0, 1) < 0.5 ? Vec3{} : 1000.0 * vector();
    const Vec3 n = normalized(w);
    Points<kA, kB> p;
    for (int end = 0; end < 2; ++end) {
      const Vec3 away = offset + (uniform(0, 1) < 0.5 ? size : 1e3 * size) * vector();
      const auto at_height = [&](double height) {
        const Vec3 v = size * vector();
        return away + (v - dot(v, n) * n) + height * n;
      };
      for (Vec3& a : p.a[end]) a = at_height(-size * std::abs(tiny()));
      for (Vec3& b : p.b[end]) b = at_height(size * tiny() - allowed);
    }
    return p;
  }

  Vec3 axis() {
    Vec3 w = vector();
    if (uniform(0, 1) < 0.3) w = {0, 0, uniform(-1, 1)};
    if (uniform(0, 1) < 0.3) w.x *= 1e-9;
    return std::pow(10, uniform(-8, 8)) * w;
  }

 private:
  std::mt19937_64 random_;
};

template <int kA, int kB>
void break_the_bound(unsigned seed, int count) {
  NearlyTouching random(seed);
  int proofs = 0, part_proofs = 0, missed = 0;
  for (int k = 0; k < count; ++k) {
    const Vec3 w = random.axis();
    const double allowed = k % 3 == 0 ? 0 : (k % 3 == 1 ? 1 : -1) * std::pow(10, random.uniform(-6, 0));
    const auto p = random.points<kA, kB>(w, allowed);
    const RelativeHulls<kA, kB> hulls(p.a[0], p.a[1], p.b[0], p.b[1]);
    const AxisProjections<kA, kB> projections(hulls, w, allowed);
    SCOPED_TRACE(testing::Message() << "seed " << seed << " case " << k << " allowed " << allowed);

    const double now = k % 2 == 0 ? 0 : random.uniform(0, 1);
    const double until = projections.separates_until(now);
    // The gap is concave in time: separation at both ends of an interval is separation throughout.
    if (until >= now) {
      ASSERT_TRUE(exactly_separated(exact_gap(p, w, Exact(now)), w, allowed));
      ASSERT_TRUE(exactly_separated(exact_gap(p, w, Exact(until)), w, allowed)) << "until " << until;
      ++part_proofs;
    } else {
      missed += exactly_separated(exact_gap(p, w, Exact(now)), w, allowed);
    }
    if (!projections.separates_throughout()) continue;
    ASSERT_TRUE(exactly_separated(exact_gap(p, w, Exact(0)), w, allowed));
    ASSERT_TRUE(exactly_separated(exact_gap(p, w, Exact(1)), w, allowed));
    ASSERT_EQ(until, 1);
    ++proofs;
  }
  std::printf("seed %u: %d proofs of all, %d of a part, %d too close to prove, of %d\n", seed, proofs, part_proofs,
              missed, count);
  EXPECT_GT(part_proofs, count / 10);
  EXPECT_GT(missed, 0) << "the cases are not near enough to test the bound";
}

TEST(SeparatingAxis, ProvesNoSeparationThatExactArithmeticDenies) {
  break_the_bound<1, 3>(31, 8000);
  break_the_bound<2, 2>(32, 8000);
  break_the_bound<3, 3>(33, 4000);
}

TEST(SeparatingAxis, NamesTheTimeUntilWhichAnApproachingHullIsApart) {
  const Vec3 a[1] = {{0, 0, 0}};
  const Vec3 b_t0[3] = {{0, 0, 1}, {1, 0, 2}, {0, 1, 3}}, b_t1[3] = {{0, 0, -3}, {1, 0, 2}, {0, 1, 3}};
  const RelativeHulls<1, 3> hulls(a, a, b_t0, b_t1);
  const AxisProjections<1, 3> up(hulls, {0, 0, 1}, 0);
  EXPECT_FALSE(up.separates_throughout());
  EXPECT_LE(up.separates_until(0), 0.25);
  EXPECT_NEAR(up.separates_until(0), 0.25, 1e-14);
  EXPECT_EQ(up.separates_until(0.3), -1);
  const AxisProjections<1, 3> with_allowance(hulls, {0, 0, 2}, 0.5);
  EXPECT_LE(with_allowance.separates_until(0), 0.375);
  EXPECT_NEAR(with_allowance.separates_until(0), 0.375, 1e-14);
}

TEST(SeparatingAxis, SeesASeparationThatBeginsLater) {
  const Vec3 a[1] = {{0, 0, 0}};
  const Vec3 b_t0[3] = {{0, 0, -1}, {1, 0, 1}, {0, 1, 1}}, b_t1[3] = {{0, 0, 3}, {1, 0, 1}, {0, 1, 1}};
  const AxisProjections<1, 3> up(RelativeHulls<1, 3>(a, a, b_t0, b_t1), {0, 0, 1}, 0);
  EXPECT_EQ(up.separates_until(0.2), -1);
  EXPECT_EQ(up.separates_until(0.3), 1);
}

TEST(SeparatingAxis, ProvesNothingWithAnAxisOrPositionsBeyondReach) {
  const Vec3 a[1] = {{0, 0, 0}};
  const Vec3 b[3] = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  const RelativeHulls<1, 3> hulls(a, a, b, b);
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vec3 w : {Vec3{0, 0, 0}, Vec3{0, 0, infinity}, Vec3{nan, 0, 1}, Vec3{0, 0, 1e300}, Vec3{0, 0, 1e-320}}) {
    const AxisProjections<1, 3> p(hulls, w, 0);
    EXPECT_FALSE(p.separates_throughout()) << w.z;
    EXPECT_EQ(p.separates_until(0), -1) << w.z;
  }
  const Vec3 far[3] = {{1e200, 1e200, 1e200}, {-1e200, 1e200, 1e200}, {1e200, -1e200, 1e200}};
  const AxisProjections<1, 3> p(RelativeHulls<1, 3>(a, a, far, far), {1e150, -1e150, 1e150}, 0);
  EXPECT_FALSE(p.separates_throughout());
}

}  // namespace
}  // namespace dismantle
