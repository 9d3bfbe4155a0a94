// SPDX-License-Identifier: Apache-2.0
#include "bench/paper/result_table.h"

#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace dismantle {
namespace {

TEST(ResultTable, IsCsvWithAHeaderLine) {
  EXPECT_EQ(csv_of({{"name", "ms"}, {{"a b", "1.5"}, {"c", "20"}}}), "name,ms\na b,1.5\nc,20\n");
}

TEST(ResultTable, IsWrittenWholeOrNotAtAll) {
  const ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "new" / "table.csv";
  ASSERT_TRUE(write_result(file, "a\n"));
  ASSERT_TRUE(write_result(file, "b\n"));
  std::ifstream stream(file);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(stream), {}), "b\n");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(file.parent_path()), {}), 1) << "no other file is left";
  EXPECT_FALSE(write_result(file / "below a file.csv", "c\n"));
}

}  // namespace
}  // namespace dismantle
