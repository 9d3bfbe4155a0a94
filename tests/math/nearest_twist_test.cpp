// SPDX-License-Identifier: Apache-2.0
#include "dismantle/math/nearest_twist.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>

namespace dismantle {
namespace {

using Vector = std::array<double, 6>;

double dot(const Vector& a, const Vector& b) {
  double sum = 0;
  for (int i = 0; i < 6; ++i) sum += a[i] * b[i];
  return sum;
}
double length(const Vector& a) {
  return std::sqrt(dot(a, a));
}
Vector minus(Vector a, const Vector& b) {
  for (int i = 0; i < 6; ++i) a[i] -= b[i];
  return a;
}
Vector scaled(Vector a, double s) {
  for (double& c : a) c *= s;
  return a;
}
Vector of(const double (&v)[6]) {
  return {v[0], v[1], v[2], v[3], v[4], v[5]};
}

NearestTwist solve(const Vector& wanted, const std::vector<HalfSpace>& rows) {
  const double w[6] = {wanted[0], wanted[1], wanted[2], wanted[3], wanted[4], wanted[5]};
  return nearest_twist(w, rows);
}

HalfSpace half_space(const Vector& normal, double bound) {
  HalfSpace h;
  std::copy(normal.begin(), normal.end(), h.normal);
  h.bound = bound;
  return h;
}

/// The largest violation by x, relative to |normal| |wanted|.
double violation(const Vector& x, const std::vector<HalfSpace>& rows, double wanted_length) {
  double worst = 0;
  for (const HalfSpace& h : rows) {
    const double scale = length(of(h.normal)) * wanted_length;
    if (scale > 0) worst = std::max(worst, (h.bound - dot(of(h.normal), x)) / scale);
  }
  return worst;
}

/// The nearest point to `wanted` with all rows of the subset as equalities; none if they are dependent.
std::optional<Vector> on_borders(const Vector& wanted, const std::vector<HalfSpace>& rows, unsigned subset) {
  Vector x = wanted;
  std::vector<Vector> basis;
  std::vector<double> value;  // of the equality b.x = value
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!(subset >> i & 1)) continue;
    Vector rest = of(rows[i].normal);
    double bound = rows[i].bound;
    const double before = length(rest);
    for (int pass = 0; pass < 2; ++pass)
      for (std::size_t k = 0; k < basis.size(); ++k) {
        const double d = dot(rest, basis[k]);
        rest = minus(rest, scaled(basis[k], d));
        bound -= d * value[k];
      }
    const double after = length(rest);
    if (!(after > 1e-10 * before) || basis.size() == 6) return std::nullopt;
    basis.push_back(scaled(rest, 1 / after));
    value.push_back(bound / after);
  }
  for (std::size_t k = 0; k < basis.size(); ++k) x = minus(x, scaled(basis[k], dot(basis[k], x) - value[k]));
  return x;
}

/// All feasible points among the nearest points of every subset of active rows: the solution is the nearest of them.
std::vector<Vector> candidates(const Vector& wanted, const std::vector<HalfSpace>& rows) {
  std::vector<Vector> found;
  for (unsigned subset = 0; subset < 1u << rows.size(); ++subset) {
    if (__builtin_popcount(subset) > 6) continue;
    const std::optional<Vector> x = on_borders(wanted, rows, subset);
    if (x && violation(*x, rows, length(wanted)) < 1e-13) found.push_back(*x);
  }
  return found;
}

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) { ::testing::Test::RecordProperty("seed", std::to_string(seed)); }
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  Vector vector() {
    Vector v;
    for (double& c : v) c = std::normal_distribution<double>()(random_);
    return v;
  }
  Vector twist_normal(double lever) {
    Vector v = vector();
    for (int i = 3; i < 6; ++i) v[i] *= lever;
    return v;
  }

 private:
  std::mt19937_64 random_;
};

/// Rows that repeat, oppose, scale and nearly repeat each other.
std::vector<HalfSpace> random_rows(Dice& dice, int count, double nearness) {
  std::vector<HalfSpace> rows;
  for (int i = 0; i < count; ++i) {
    const int kind = rows.empty() ? 0 : dice.integer(0, 5);
    const HalfSpace& other = rows.empty() ? HalfSpace{} : rows[static_cast<std::size_t>(dice.integer(0, i - 1))];
    Vector normal = dice.twist_normal(dice.log_uniform(1, 100));
    if (kind == 1) normal = scaled(of(other.normal), dice.log_uniform(1e-3, 1e3));
    if (kind == 2) normal = scaled(of(other.normal), -1);
    if (kind == 3 || kind == 4) {
      const Vector base = scaled(of(other.normal), kind == 3 ? 1 : -1);
      normal = minus(base, scaled(normal, nearness * length(base) / length(normal)));
    }
    if (kind == 5 && i > 1) normal = minus(of(rows[0].normal), of(rows[1].normal));
    rows.push_back(half_space(normal, dice.integer(0, 1) ? 0 : -length(normal) * dice.log_uniform(1e-4, 1)));
  }
  return rows;
}

void expect_like_brute_force(Dice& dice, int problems, int rows_at_most, double nearness, double accuracy) {
  for (int k = 0; k < problems; ++k) {
    const std::vector<HalfSpace> rows = random_rows(dice, dice.integer(1, rows_at_most), nearness);
    const Vector wanted = dice.vector();
    const NearestTwist got = solve(wanted, rows);
    const Vector x = of(got.x);
    const double scale = length(wanted);
    ASSERT_TRUE(got.nearest) << "problem " << k;
    ASSERT_LE(violation(x, rows, scale), kNearestTwistSlack) << "problem " << k;
    double minimum = scale;  // 0 is feasible
    for (const Vector& y : candidates(wanted, rows)) {
      minimum = std::min(minimum, length(minus(wanted, y)));
      // Optimality: no direction to a feasible point leads nearer.
      ASSERT_LE(dot(minus(wanted, x), minus(y, x)), accuracy * scale * scale) << "problem " << k;
    }
    ASSERT_NEAR(length(minus(wanted, x)), minimum, accuracy * scale) << "problem " << k;
  }
}

/// Facets of a hole along z around a peg that fills it: contact points along the peg.
std::vector<HalfSpace> hole(int facets, double radius, double half_length, double gap) {
  std::vector<HalfSpace> rows;
  for (int i = 0; i < facets; ++i) {
    const double a = 2 * std::acos(-1.0) * i / facets;
    const double nx = -std::cos(a), ny = -std::sin(a);
    for (const double z : {-half_length, half_length}) {
      const double px = -radius * nx, py = -radius * ny;
      rows.push_back(half_space({nx, ny, 0, py * 0 - z * ny, z * nx - px * 0, px * ny - py * nx}, -gap));
    }
  }
  return rows;
}

TEST(NearestTwist, IsTheWantedTwistWithoutConstraints) {
  const Vector wanted = {1, -2, 3, 0.1, 0.2, -0.3};
  EXPECT_EQ(of(solve(wanted, {}).x), wanted);
  const NearestTwist got = solve(wanted, {half_space({1, 0, 0, 0, 0, 0}, 0), half_space({0, 0, 0, 0, 0, 0}, 0)});
  EXPECT_LE(length(minus(of(got.x), wanted)), 1e-15);
  EXPECT_EQ(got.active_count, 0);
  EXPECT_TRUE(got.nearest);
}

TEST(NearestTwist, StopsAtAPlaneAtItsGapAndSlidesAlong) {
  const NearestTwist got = solve({3, -4, 1, 0, 0, 0}, {half_space({0, 2, 0, 0, 0, 0}, -1)});
  EXPECT_NEAR(got.x[0], 3, 1e-14);
  EXPECT_NEAR(got.x[1], -0.5, 1e-14);
  EXPECT_NEAR(got.x[2], 1, 1e-14);
  ASSERT_EQ(got.active_count, 1);
  EXPECT_EQ(got.active[0], 0);
}

TEST(NearestTwist, ReleasesAConstraintThatWouldHaveToPull) {
  // Only the second plane blocks the wanted point; the first is violated more at the start.
  const std::vector<HalfSpace> rows = {half_space({0.6, 0.8, 0, 0, 0, 0}, 0), half_space({0, 1, 0, 0, 0, 0}, 0)};
  const NearestTwist got = solve({0.1, -1, 0, 0, 0, 0}, rows);
  EXPECT_NEAR(got.x[0], 0.1, 1e-14);
  EXPECT_NEAR(got.x[1], 0, 1e-14);
  ASSERT_EQ(got.active_count, 1);
  EXPECT_EQ(got.active[0], 1);
}

TEST(NearestTwist, IsZeroIfEveryDirectionIsBlocked) {
  std::vector<HalfSpace> rows;
  for (int i = 0; i < 6; ++i)
    for (const double sign : {-1.0, 1.0}) {
      Vector normal{};
      normal[static_cast<std::size_t>(i)] = sign;
      rows.push_back(half_space(normal, 0));
    }
  EXPECT_LE(length(of(solve({1, 2, 3, 4, 5, 6}, rows).x)), 1e-12);
  EXPECT_EQ(length(of(solve({0, 0, 0, 0, 0, 0}, rows).x)), 0);
}

TEST(NearestTwist, AgreesWithBruteForceOnRandomProblems) {
  Dice dice(20260101);
  expect_like_brute_force(dice, 2000, 7, 0.3, 1e-9);
  expect_like_brute_force(dice, 100, 12, 0.3, 1e-9);
}

TEST(NearestTwist, AgreesWithBruteForceOnNearlyDegenerateProblems) {
  Dice dice(20260102);
  // An error e of a plane moves the corner of planes at an angle a by e / a.
  for (const double nearness : {1e-2, 1e-4, 1e-6}) expect_like_brute_force(dice, 500, 7, nearness, 1e-11 / nearness);
  expect_like_brute_force(dice, 60, 12, 1e-5, 1e-6);
}

TEST(NearestTwist, IsFeasibleAndNoFartherThanZeroForAnyDegreeOfDependence) {
  Dice dice(20260103);
  for (int k = 0; k < 20000; ++k) {
    const std::vector<HalfSpace> rows = random_rows(dice, dice.integer(1, 40), dice.log_uniform(1e-16, 1));
    const Vector wanted = scaled(dice.vector(), dice.log_uniform(1e-6, 1e6));
    const NearestTwist got = solve(wanted, rows);
    ASSERT_LE(violation(of(got.x), rows, length(wanted)), kNearestTwistSlack) << "problem " << k;
    ASSERT_LE(length(minus(of(got.x), wanted)), (1 + 1e-15) * length(wanted)) << "problem " << k;
    ASSERT_LE(got.iterations, kNearestTwistIterations);
    ASSERT_LE(got.active_count, 6);
  }
}

TEST(NearestTwist, ProjectsOntoTheConeOfAHoleWithHundredsOfFacets) {
  for (const double lever : {1.0, 20.0, 100.0}) {
    // A pull along the hole with a push aside and a tilt: only the pull and the rotation about the axis remain.
    const NearestTwist got = solve({0.3, -0.2, 1, 0.06, 0.01, 0.02}, hole(256, 5, lever, 0));
    EXPECT_TRUE(got.nearest);
    EXPECT_LE(length(minus(of(got.x), {0, 0, 1, 0, 0, 0.02})), 1e-9);
    EXPECT_LT(got.iterations, 40);
  }
}

TEST(NearestTwist, IsNonExpansiveAndIdempotent) {
  Dice dice(20260104);
  for (int k = 0; k < 3000; ++k) {
    const std::vector<HalfSpace> rows =
        k % 10 == 0 ? hole(dice.integer(3, 128), 5, dice.log_uniform(1, 50), dice.log_uniform(1e-4, 1e-1))
                    : random_rows(dice, dice.integer(1, 24), 0.1);
    const Vector a = dice.vector(), b = minus(a, scaled(dice.vector(), dice.log_uniform(1e-5, 1)));
    const Vector pa = of(solve(a, rows).x), pb = of(solve(b, rows).x);
    ASSERT_LE(length(minus(pa, pb)), length(minus(a, b)) + 1e-9) << "problem " << k;
    ASSERT_LE(length(minus(of(solve(pa, rows).x), pa)), 1e-9) << "problem " << k;
  }
}

TEST(NearestTwist, DoesNotDependOnTheScaleOfRowsNorOfTheMotion) {
  Dice dice(20260105);
  for (int k = 0; k < 2000; ++k) {
    const std::vector<HalfSpace> rows = random_rows(dice, dice.integer(1, 20), 0.1);
    const Vector wanted = dice.vector();
    const double size = dice.log_uniform(1e-150, 1e150);
    std::vector<HalfSpace> other;
    for (const HalfSpace& h : rows) {
      const double by = dice.log_uniform(1e-100, 1e100);
      other.push_back(half_space(scaled(of(h.normal), by), h.bound * by * size));
    }
    const Vector x = of(solve(wanted, rows).x), y = of(solve(scaled(wanted, size), other).x);
    ASSERT_LE(length(minus(x, scaled(y, 1 / size))), 1e-9) << "problem " << k;
  }
}

TEST(NearestTwist, GivesTheSameForTheSameInput) {
  Dice dice(20260106);
  const std::vector<HalfSpace> rows = random_rows(dice, 60, 1e-3);
  const Vector wanted = dice.vector();
  EXPECT_EQ(solve(wanted, rows), solve(wanted, rows));
}

}  // namespace
}  // namespace dismantle
