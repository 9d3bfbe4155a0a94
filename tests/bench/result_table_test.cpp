// SPDX-License-Identifier: Apache-2.0
#include "bench/paper/result_table.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

const ResultTable kTable{{"name", "ms"}, {{"a, b", "1.5"}, {"c", "20"}}};

TEST(ResultTable, IsCsvWithFieldsQuotedWhereTheyNeedIt) {
  EXPECT_EQ(csv_of(kTable), "name,ms\n\"a, b\",1.5\nc,20\n");
}

TEST(ResultTable, IsAMarkdownTable) {
  EXPECT_EQ(markdown_of(kTable), "| name | ms |\n| --- | --- |\n| a, b | 1.5 |\n| c | 20 |\n");
}

TEST(ResultTable, GivesColumnsInAnotherOrder) {
  const ResultTable chosen = columns_of(kTable, {"ms", "name"});
  EXPECT_EQ(chosen.columns, (std::vector<std::string>{"ms", "name"}));
  EXPECT_EQ(chosen.rows[1], (std::vector<std::string>{"20", "c"}));
}

}  // namespace
}  // namespace dismantle
