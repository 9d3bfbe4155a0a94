// SPDX-License-Identifier: Apache-2.0
#include "dismantle/math/wide_integer.h"

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>
#include <limits>
#include <random>

namespace dismantle {
namespace {

using Integer = boost::multiprecision::cpp_int;

constexpr std::uint64_t kSeed = 20240612;
constexpr int kUnit = -1074;

template <int kLimbs>
Integer value_of(const WideInteger<kLimbs>& w) {
  Integer value = 0;
  for (int i = w.size - 1; i >= 0; --i) value = (value << 32) + w.limb[i];
  return w.sign * value;
}

double any_finite(std::mt19937_64& random) {
  for (;;) {
    const std::uint64_t bits = random();
    double x = 0;
    std::memcpy(&x, &bits, sizeof x);
    if (std::isfinite(x)) return x;
  }
}

TEST(WideInteger, RepresentsEveryFiniteDouble) {
  using Limits = std::numeric_limits<double>;
  EXPECT_EQ(value_of(wide_integer_of<66>(Limits::denorm_min(), kUnit)), 1);
  EXPECT_EQ(value_of(wide_integer_of<66>(-Limits::min(), kUnit)), -(Integer(1) << 52));
  EXPECT_EQ(value_of(wide_integer_of<66>(Limits::max(), kUnit)), (((Integer(1) << 53) - 1) << 2045));
  EXPECT_EQ(value_of(wide_integer_of<66>(0.0, kUnit)), 0);
  EXPECT_EQ(value_of(wide_integer_of<66>(-0.0, kUnit)), 0);
}

TEST(WideInteger, AddsSubtractsAndMultipliesLikeABigInteger) {
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 3000; ++i) {
    const double x = any_finite(random), y = i % 3 == 0 ? std::nextafter(x, 0) : any_finite(random);
    const auto a = wide_integer_of<66>(x, kUnit), b = wide_integer_of<66>(y, kUnit);
    ASSERT_EQ(value_of(a + b), value_of(a) + value_of(b)) << "seed " << kSeed;
    ASSERT_EQ(value_of(a - b), value_of(a) - value_of(b)) << "seed " << kSeed;
    ASSERT_EQ(value_of(a * b), value_of(a) * value_of(b)) << "seed " << kSeed;
    ASSERT_EQ((a - a).sign, 0);
    ASSERT_EQ((a * b - a * b).size, 0);
  }
}

}  // namespace
}  // namespace dismantle
