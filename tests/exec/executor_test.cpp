// SPDX-License-Identifier: Apache-2.0
#include "dismantle/exec/executor.h"

#include "dismantle/exec/append_buffer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace dismantle {
namespace {

std::vector<Executor> all_executors() {
  return {Executor(ExecutorKind::Serial), Executor(ExecutorKind::Shuffled), Executor(ExecutorKind::Threads, 1),
          Executor(ExecutorKind::Threads, 2), Executor(ExecutorKind::Threads, 7)};
}

TEST(Executor, RunsEveryItemOnce) {
  for (const Executor& exec : all_executors()) {
    for (const std::size_t count : {0u, 1u, 255u, 256u, 10'007u}) {
      std::vector<int> seen(count, 0);
      exec.for_each(count, [&](std::size_t i) { ++seen[i]; });
      EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<long>(count));
    }
  }
}

TEST(Executor, SortsKeys) {
  std::mt19937_64 random(7);
  std::vector<std::uint64_t> keys(100'000);
  for (std::uint64_t& k : keys) k = random();
  std::vector<std::uint64_t> expected = keys;
  std::sort(expected.begin(), expected.end());
  for (const Executor& exec : all_executors()) {
    std::vector<std::uint64_t> sorted = keys;
    exec.sort(sorted);
    EXPECT_EQ(sorted, expected);
  }
}

TEST(AppendBuffer, LosesNothingFromCapacityOne) {
  for (const Executor& exec : all_executors()) {
    AppendBuffer<std::uint64_t> buffer(1);
    const int runs = append_with_replay(buffer, [&](AppendView<std::uint64_t> view) {
      exec.for_each(5000, [&](std::size_t i) {
        if (i % 3 == 0) view.append(i);
      });
    });
    EXPECT_EQ(runs, 2);
    std::vector<std::uint64_t> values(buffer.values().begin(), buffer.values().end());
    std::sort(values.begin(), values.end());
    ASSERT_EQ(values.size(), 1667u);
    for (std::size_t k = 0; k < values.size(); ++k) EXPECT_EQ(values[k], 3 * k);
  }
}

}  // namespace
}  // namespace dismantle
