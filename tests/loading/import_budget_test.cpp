// SPDX-License-Identifier: Apache-2.0
#include "dismantle/loading/import_budget.h"

#include "dismantle/isolation/confinement.h"
#include "dismantle/loading/load_assembly.h"
#include "tests/formats/gltf_files.h"
#include "tests/support/parse_expectations.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

TEST(ImportBudget, FollowsTheSizeOfTheFile) {
  const FormatEntry* step = format_of("a.step");
  const IsolationLimits small = import_budget(step, 1000, {}), large = import_budget(step, 20'000'000, {});
  EXPECT_GE(small.memory_bytes, std::uint64_t{512} << 20);  // twenty times what a file of a few kilobytes takes
  EXPECT_LE(large.memory_bytes, std::uint64_t{3} << 30);
  EXPECT_LE(large.cpu_seconds, 400);
  EXPECT_LT(import_budget(format_of("a.stl"), 20'000'000, {}).cpu_seconds, large.cpu_seconds);
}

TEST(ImportBudget, GrowsWithAFinerMeshAndIsWhatTheUserSays) {
  ImportOptions options;
  options.deflection = 0.001;
  EXPECT_GT(import_budget(format_of("a.step"), 1000, options).cpu_seconds, 400);
  options.limits.memory_bytes = 12345;
  options.limits.cpu_seconds = 678;
  const IsolationLimits limits = import_budget(format_of("a.step"), 1000, options);
  EXPECT_EQ(limits.memory_bytes, 12345u);
  EXPECT_EQ(limits.cpu_seconds, 678);
  EXPECT_EQ(limits.silence_seconds, 678);
}

TEST(ImportBudget, EndsAReadThatTakesMore) {
  if (kUnderSanitizer) GTEST_SKIP() << "memory is not limited under the sanitizers";
  const ScratchFolder folder;
  std::string obj;
  for (int i = 0; i < 300'000; ++i) obj += "v " + std::to_string(i) + " 0 0\nv 0 1 0\nv 0 0 1\nf -1 -2 -3\n";
  const auto file = folder.put("large.obj", obj);
  ImportOptions options;
  EXPECT_TRUE(load_assembly(file, options).ok());
  options.limits.memory_bytes = 20 << 20;
  expect_unreadable(load_assembly(file, options), "it takes more memory than files of its size do");
}

TEST(ImportBudget, IsNotTakenForAFaultOfTheFile) {
  if (kUnderSanitizer) GTEST_SKIP() << "memory is not limited under the sanitizers";
  ImportOptions options;
  for (const std::uint64_t mebibytes : {10, 30, 60}) {  // OpenCASCADE goes on without what it did not get
    options.limits.memory_bytes = mebibytes << 20;
    expect_unreadable(load_assembly(DISMANTLE_SOURCE_DIR "/samples/lathe.step", options), "it takes more memory");
  }
}

}  // namespace
}  // namespace dismantle
