// SPDX-License-Identifier: Apache-2.0
#include "bench/soak/record.h"
#include "dismantle/engine/classify_pairs.h"
#include "tests/support/meshes.h"
#include "tests/support/random_scenes.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

namespace dismantle::soak {
namespace {

/// Three boxes in a row that touch.
Assembly row_of_boxes() {
  return scenes::assembly({scenes::component("left", scenes::box({0, 0, 0}, {10, 10, 10})),
                           scenes::component("middle", scenes::box({10, 0, 0}, {20, 10, 10})),
                           scenes::component("right", scenes::box({20, 0, 0}, {30, 10, 10}))});
}

TEST(SoakBatch, DependsOnItsSeedAlone) {
  const Assembly assembly = row_of_boxes();
  const PairStates states = *classify_pairs(assembly, {});
  const PathAuditor auditor(assembly);
  BatchOptions options;
  options.targets = 12;
  const auto surfaces = CertificateEngine(assembly, states).surfaces();
  const Batch first = run_batch(assembly, states, nullptr, auditor, 5, options),
              again = run_batch(assembly, states, surfaces, auditor, 5, options);
  EXPECT_EQ(first.result.steps, again.result.steps);
  EXPECT_EQ(first.path.moves.size(), again.path.moves.size());
  EXPECT_EQ(first.result.straight_motions, again.result.straight_motions);
  EXPECT_GE(first.result.steps, 12u);
  EXPECT_GT(first.result.straight_motions, 0u);
  EXPECT_TRUE(first.result.good()) << first.result.message;
  EXPECT_EQ(first.result.audits_cut, 0u);
}

BatchResult result_with(std::size_t steps, double us) {
  BatchResult result;
  result.batches = 1;
  result.steps = steps;
  for (std::size_t k = 0; k < steps; ++k) result.times.add(us);
  result.longest_us = us;
  return result;
}

TEST(SoakRecord, GoesOnFromAFileWhoseLastLineWasNotFinished) {
  const ScratchFolder folder;
  const std::string file = (folder / "record.jsonl").string();
  {
    Result<Record> record = Record::open(file, 1, 50);
    ASSERT_TRUE(record) << record.error().message;
    ASSERT_TRUE(record->add("one", 0, result_with(150, 20)));
    ASSERT_TRUE(record->add("one", 3, result_with(150, 40)));
  }
  std::ofstream(file, std::ios::app) << "{\"assembly\": \"one\", \"bat";
  {
    Result<Record> record = Record::open(file, 1, 50);
    ASSERT_TRUE(record) << record.error().message;
    EXPECT_TRUE(record->has("one", 0));
    EXPECT_FALSE(record->has("one", 1));
    EXPECT_TRUE(record->has("one", 3));
    ASSERT_TRUE(record->add("two", 0, result_with(10, 5)));
  }
  Result<Record> record = Record::open(file, 1, 50);
  ASSERT_TRUE(record) << record.error().message;
  EXPECT_TRUE(record->has("two", 0));
  EXPECT_EQ(record->of("one").batches, 2u);
  EXPECT_EQ(record->of("one").steps, 300u);
  EXPECT_EQ(record->of("one").longest_us, 40);
  EXPECT_NEAR(record->of("one").times.quantile(0.5), 20, 1);
  EXPECT_NEAR(record->of("one").times.quantile(0.99), 40, 2);
  EXPECT_EQ(std::ranges::count(bytes_of(file), '\n'), 3) << "the settings, and one line of each assembly";
}

TEST(SoakRecord, IsNotMixedWithOtherSettings) {
  const ScratchFolder folder;
  const std::string file = (folder / "record.jsonl").string();
  ASSERT_TRUE(Record::open(file, 1, 50));
  EXPECT_FALSE(Record::open(file, 2, 50));
  std::ofstream(file) << "not a record\n";
  EXPECT_FALSE(Record::open(file, 1, 50));
}

TEST(TimeHistogram, GivesQuantilesToFivePercent) {
  TimeHistogram times;
  for (int k = 1; k <= 1000; ++k) times.add(k);
  EXPECT_NEAR(times.quantile(0.5), 500, 25);
  EXPECT_NEAR(times.quantile(0.99), 990, 50);
  EXPECT_EQ(TimeHistogram().quantile(0.5), 0);
}

}  // namespace
}  // namespace dismantle::soak
