// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/csv_text.h"

#include <gtest/gtest.h>

#include <limits>

namespace dismantle {
namespace {

TEST(CsvText, QuotesOnlyWhereNeeded) {
  EXPECT_EQ(csv_field(std::string_view("lid screw M6x22")), "lid screw M6x22");
  EXPECT_EQ(csv_field(std::string_view("a,b")), "\"a,b\"");
  EXPECT_EQ(csv_field(std::string_view("3/8\" nut")), "\"3/8\"\" nut\"");
  EXPECT_EQ(csv_field(std::string_view("two\nlines")), "\"two\nlines\"");
}

TEST(CsvText, WritesShortNumbersWithADecimalPoint) {
  EXPECT_EQ(csv_field(0.1 + 0.2), "0.3");
  EXPECT_EQ(csv_field(-0.0), "0");
  EXPECT_EQ(csv_field(1.0 / 3), "0.333333333");
  EXPECT_EQ(csv_field(std::numeric_limits<double>::infinity()), "");
  EXPECT_EQ(csv_field(std::size_t{12}), "12");
}

TEST(CsvText, EndsRowsAsTheStandardSays) {
  EXPECT_EQ(csv_row({"a", "", "c"}), "a,,c\r\n");
}

}  // namespace
}  // namespace dismantle
