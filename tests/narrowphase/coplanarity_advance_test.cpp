// SPDX-License-Identifier: Apache-2.0
#include "dismantle/narrowphase/coplanarity_advance.h"

#include "dismantle/narrowphase/nonpenetration_filter.h"
#include "tests/narrowphase/exact_motions.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>

namespace dismantle {
namespace {

using Exact = boost::multiprecision::cpp_rational;

Exact exact_volume(const Vec3 (&p)[2], const Vec3 (&q)[2], const Vec3 (&r)[2], const Exact& s) {
  const auto at = [&s](double start, double finish) { return Exact((1 - s) * Exact(start) + s * Exact(finish)); };
  const Exact p_now[3] = {at(p[0].x, p[1].x), at(p[0].y, p[1].y), at(p[0].z, p[1].z)};
  const Exact q_now[3] = {at(q[0].x, q[1].x), at(q[0].y, q[1].y), at(q[0].z, q[1].z)};
  const Exact r_now[3] = {at(r[0].x, r[1].x), at(r[0].y, r[1].y), at(r[0].z, r[1].z)};
  return (p_now[1] * q_now[2] - p_now[2] * q_now[1]) * r_now[0] +
         (p_now[2] * q_now[0] - p_now[0] * q_now[2]) * r_now[1] +
         (p_now[0] * q_now[1] - p_now[1] * q_now[0]) * r_now[2];
}

TEST(CoplanarityCubic, KeepsEveryCoefficientWithinItsBound) {
  constexpr unsigned kSeed = 51;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&] { return Vec3{unit(random), unit(random), unit(random)}; };
  double worst = 0;
  for (int k = 0; k < 5000; ++k) {
    // Nearly dependent vectors: the volume is below the rounding errors.
    Vec3 p[2] = {vector(), vector()}, q[2] = {vector(), vector()}, r[2];
    for (int end = 0; end < 2; ++end)
      r[end] = unit(random) * p[end] + unit(random) * q[end] + std::pow(10, 10 * unit(random) - 10) * vector();
    const BernsteinCubic cubic = coplanarity_cubic(p, q, r);
    const Exact start = exact_volume(p, q, r, 0), finish = exact_volume(p, q, r, 1);
    const Exact third = exact_volume(p, q, r, Exact(1, 3)) * 27, two_thirds = exact_volume(p, q, r, Exact(2, 3)) * 27;
    // Values at 1/3 and 2/3 to Bernstein coefficients.
    const Exact c1 = (2 * (third - 8 * start - finish) - (two_thirds - start - 8 * finish)) / 18;
    const Exact c2 = (2 * (two_thirds - start - 8 * finish) - (third - 8 * start - finish)) / 18;
    const Exact exact[4] = {start, c1, c2, finish};
    for (int i = 0; i < 4; ++i) {
      const double off = std::abs(static_cast<double>(Exact(cubic.c[i]) - exact[i]));
      // Here the vectors are exact; differences of positions may round once more, which the bound allows.
      ASSERT_LE(off, cubic.error / 1.3) << "seed " << kSeed << " case " << k << " coefficient " << i;
      worst = std::max(worst, off / cubic.error);
    }
  }
  std::printf("seed %u: the largest error is %.2f of the bound\n", kSeed, worst);
}

template <class Hit>
void expect_advance_before(const Hit& hit, unsigned seed, int k, int& close) {
  const BernsteinCubic cubic = coplanarity_cubic(hit.motion);
  ASSERT_FALSE(certainly_never_coplanar(cubic)) << "seed " << seed << " motion " << k;
  double t = 0;
  for (const double from : {0.0, 0.3, 0.9}) {
    if (from * hit.time < t) continue;
    t = coplanarity_advance(cubic, from * hit.time);
    ASSERT_GE(t, from * hit.time) << "seed " << seed << " motion " << k;
    ASSERT_LE(t, hit.time) << "seed " << seed << " motion " << k << " from " << from;
  }
  close += t > hit.time - 1e-6;
}

TEST(CoplanarityAdvance, NeverPassesATimeAtWhichThePointsAreExactlyInOnePlane) {
  constexpr unsigned kSeed = 52;
  exact::Generator generator(kSeed);
  int close = 0;
  for (int k = 0; k < 100000; ++k) {
    expect_advance_before(generator.vertex_face(), kSeed, k, close);
    expect_advance_before(generator.edge_edge(), kSeed, k, close);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(close, 60000);
}

TEST(CoplanarityAdvance, ReachesTheEndIfThereIsNoRootAhead) {
  const BernsteinCubic behind{{-1, 1, 2, 3}, 1e-15};
  EXPECT_EQ(coplanarity_advance(behind, 0.5), 1);
  const BernsteinCubic dips{{1, -0.1, -0.1, 1}, 1e-15};
  EXPECT_EQ(coplanarity_advance(dips, 0), 1) << "negative coefficients, but positive throughout";
}

TEST(CoplanarityAdvance, StaysIfThePointsCannotBeDistinguishedFromCoplanar) {
  EXPECT_EQ(coplanarity_advance({{1e-17, 1, 1, 1}, 1e-15}, 0), 0);
  EXPECT_EQ(coplanarity_advance({{0, 0, 0, 0}, 0}, 0.25), 0.25);
}

}  // namespace
}  // namespace dismantle
