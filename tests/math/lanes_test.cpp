// SPDX-License-Identifier: Apache-2.0
#include "dismantle/math/lanes.h"

#include "dismantle/math/lane_dispatch.h"
#include "tests/math/lanes_test_run.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace dismantle {

void lanes_test_portable(const LaneOperands& operands, LaneResults* results) {
  run_lane_operations<4, PortableLaneOperations>(operands, results);
}

namespace {

constexpr int kCount = 16 * 1024;
constexpr unsigned kSeed = 3001;

struct Numbers {
  std::vector<float> a, b, c;

  LaneOperands operands() const { return {a.data(), b.data(), c.data(), kCount}; }
};

/// Random bits (numbers of every size, infinities, subnormals, NaN), mixed with equal and special numbers.
Numbers numbers() {
  std::printf("seed %u\n", kSeed);
  std::mt19937 random(kSeed);
  const float infinity = std::numeric_limits<float>::infinity();
  const float special[] = {
      0.0f,      -0.0f,      1.0f, -1.0f, infinity, -infinity, std::numeric_limits<float>::quiet_NaN(),
      0x1p-149f, -0x1p-127f, 3e38f};
  const auto next = [&] {
    const unsigned kind = random() % 8;
    if (kind == 0) return special[random() % std::size(special)];
    if (kind < 4) return std::ldexp(static_cast<float>(random()), static_cast<int>(random() % 20) - 40);
    return std::bit_cast<float>(static_cast<std::uint32_t>(random()));
  };
  Numbers n;
  for (int i = 0; i < kCount; ++i) {
    n.a.push_back(next());
    n.b.push_back(random() % 16 == 0 ? n.a.back() : next());
    n.c.push_back(next());
  }
  return n;
}

/// The results of single floats.
LaneResults expected(float a, float b, float c, float first) {
  return {{a + b, a - b, a * b, a / b, -a, a < b ? a : b, a > b ? a : b, std::fabs(a), std::sqrt(a), a < b ? a : c,
           first, a * b + c},
          {a<b, a <= b, a> b, a >= b, a == b, a < b && b < c, a < b || !(b < c), false, false}};
}

bool same_bits(float x, float y) {
  return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y) || (std::isnan(x) && std::isnan(y));
}

void expect_scalar_results(const Numbers& n, const std::vector<LaneResults>& results, int lanes) {
  for (int i = 0; i < kCount; ++i) {
    const int start = i / lanes * lanes;
    LaneResults e = expected(n.a[i], n.b[i], n.c[i], n.a[start]);
    e.truth[8] = true;
    for (int k = start; k < start + lanes; ++k) {
      e.truth[7] |= n.a[k] < n.b[k];
      e.truth[8] &= n.a[k] < n.b[k];
    }
    for (int k = 0; k < LaneResults::kNumbers; ++k)
      ASSERT_TRUE(same_bits(results[i].number[k], e.number[k]))
          << "operation " << k << " of " << n.a[i] << ", " << n.b[i] << ", " << n.c[i] << " in " << lanes
          << " lanes: " << results[i].number[k] << " for " << e.number[k];
    for (int k = 0; k < LaneResults::kTruths; ++k)
      ASSERT_EQ(results[i].truth[k], e.truth[k])
          << "comparison " << k << " of " << n.a[i] << ", " << n.b[i] << ", " << n.c[i] << " in " << lanes << " lanes";
  }
}

TEST(Lanes, GiveTheBitsOfAFloatInEveryOperationAtEveryWidth) {
  const Numbers n = numbers();
  for (const LaneCount count : lane_counts()) {
    std::vector<LaneResults> results(kCount);
    with_lanes(count, [&](auto lanes) { lanes_test_kernel<lanes>(n.operands(), results.data()); });
    expect_scalar_results(n, results, static_cast<int>(count));
  }
}

TEST(Lanes, GiveTheBitsOfAFloatOnMachinesThatAreNotX86) {
  const Numbers n = numbers();
  std::vector<LaneResults> results(kCount);
  lanes_test_portable(n.operands(), results.data());
  expect_scalar_results(n, results, 4);
}

TEST(LaneDispatch, ListsTheWidthsInAscendingOrder) {
  const Span<const LaneCount> counts = lane_counts();
  ASSERT_GE(counts.size(), 2u);
  EXPECT_EQ(counts[0], LaneCount::One);
  EXPECT_EQ(counts[1], LaneCount::Four);
  for (std::size_t i = 1; i < counts.size(); ++i) EXPECT_LT(counts[i - 1], counts[i]);
  EXPECT_EQ(widest_lanes(), counts[counts.size() - 1]);
  for (const LaneCount count : counts)
    EXPECT_EQ(with_lanes(count, [](auto lanes) { return int{lanes}; }), static_cast<int>(count));
}

}  // namespace
}  // namespace dismantle
