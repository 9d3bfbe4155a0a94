// SPDX-License-Identifier: Apache-2.0
#include "dismantle/exec/radix_sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace dismantle {
namespace {

TEST(RadixSort, SortsAnyNumberOfKeysThatDifferInAnyBits) {
  std::mt19937_64 random(11);
  std::vector<std::uint64_t> scratch;
  for (const std::size_t count : {0u, 1u, 1023u, 1024u, 50'000u}) {
    for (const std::uint64_t mask : {~0ull, 0ull, 0x3ffffull << 32 | 0x1ffffull, 1ull << 63, 0x800ull}) {
      std::vector<std::uint64_t> keys(count);
      for (std::uint64_t& k : keys) k = (random() & mask) | (0x5555555555555555ull & ~mask);
      std::vector<std::uint64_t> expected = keys;
      std::sort(expected.begin(), expected.end());
      radix_sort(keys, scratch);
      EXPECT_EQ(keys, expected);
    }
  }
}

}  // namespace
}  // namespace dismantle
