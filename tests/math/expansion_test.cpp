// SPDX-License-Identifier: Apache-2.0
#include "dismantle/math/expansion.h"

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>
#include <random>

namespace dismantle {
namespace {

using Rational = boost::multiprecision::cpp_rational;

constexpr std::uint64_t kSeed = 20240611;

double log_uniform(std::mt19937_64& random, int largest_exponent) {
  std::uniform_int_distribution<int> exponent(-largest_exponent, largest_exponent);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  const double m = mantissa(random);
  return std::ldexp(m, exponent(random));
}

template <int kN>
Rational value_of(const Expansion<kN>& e) {
  Rational sum = 0;
  for (int i = 0; i < e.size; ++i) sum += Rational(e.term[i]);
  return sum;
}

/// True if the terms ascend and their bits do not overlap.
template <int kN>
bool is_nonoverlapping(const Expansion<kN>& e) {
  for (int i = 0; i < e.size; ++i)
    if (e.term[i] == 0) return false;
  for (int i = 1; i < e.size; ++i) {
    int lowest = std::ilogb(e.term[i]) - 52;
    while (std::fmod(e.term[i], std::ldexp(1, lowest + 1)) == 0) ++lowest;
    if (std::fabs(e.term[i - 1]) >= std::ldexp(1, lowest)) return false;
  }
  return true;
}

TEST(Expansion, SumsAndProductsOfTwoDoublesLoseNothing) {
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 20000; ++i) {
    const double a = log_uniform(random, 60), b = log_uniform(random, 60);
    const TwoTerms sum = two_sum(a, b), product = two_product(a, b);
    ASSERT_EQ(sum.high, a + b);
    ASSERT_EQ(Rational(sum.high) + Rational(sum.low), Rational(a) + Rational(b)) << "seed " << kSeed;
    ASSERT_EQ(product.high, a * b);
    ASSERT_EQ(Rational(product.high) + Rational(product.low), Rational(a) * Rational(b)) << "seed " << kSeed;
  }
}

TEST(Expansion, LongSumsAndProductsAreExactNonoverlappingAndHaveTheRightSign) {
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 3000; ++i) {
    const double scale = log_uniform(random, 40);
    const TwoTerms a = two_sum(log_uniform(random, 60), log_uniform(random, 60));
    const TwoTerms b = two_sum(log_uniform(random, 60), log_uniform(random, 60));
    const auto product = expansion_of(a) * expansion_of(b);
    const auto scaled = product * scale;
    const auto difference = scaled + -product;
    const Rational exact_product = (Rational(a.high) + Rational(a.low)) * (Rational(b.high) + Rational(b.low));
    const Rational exact = exact_product * (Rational(scale) - 1);
    ASSERT_EQ(value_of(product), exact_product) << "seed " << kSeed;
    ASSERT_EQ(value_of(difference), exact) << "seed " << kSeed;
    ASSERT_TRUE(is_nonoverlapping(difference)) << "seed " << kSeed;
    ASSERT_EQ(difference.sign(), exact.sign()) << "seed " << kSeed;
    ASSERT_NEAR(difference.estimate(), static_cast<double>(exact), 4 * 0x1p-53 * std::fabs(difference.estimate()));
  }
}

TEST(Expansion, ThatCancelsIsEmpty) {
  const auto e = expansion_of(two_product(0.1, 0.3)) * 7.0;
  const auto none = e + -e;
  EXPECT_EQ(none.size, 0);
  EXPECT_EQ(none.sign(), 0);
  EXPECT_EQ(none.estimate(), 0);
}

}  // namespace
}  // namespace dismantle
