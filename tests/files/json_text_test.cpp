// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/json_text.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <random>

namespace dismantle {
namespace {

TEST(JsonLine, KeepsTheOrderOfMembersAndSpacesThem) {
  const JsonValue value{{"b", 1}, {"a", {true, nullptr, "x"}}, {"empty", JsonValue::array()}};
  EXPECT_EQ(json_line(value), R"({"b": 1, "a": [true, null, "x"], "empty": []})");
}

TEST(JsonLine, WritesNumbersAsTheShortestTextThatReadsBackAlike) {
  EXPECT_EQ(json_line(0.1), "0.1");
  EXPECT_EQ(json_line(5.0), "5");
  EXPECT_EQ(json_line(-0.0), "-0.0");
  std::mt19937_64 random(7);
  for (int i = 0; i < 10'000; ++i) {
    const double number = std::bit_cast<double>(random());
    if (!(std::abs(number) <= std::numeric_limits<double>::max())) continue;
    const double back = nlohmann::json::parse(json_line(number)).get<double>();
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(number));
  }
}

TEST(JsonLine, EscapesTextAndReplacesBytesThatAreNotUtf8) {
  EXPECT_EQ(json_line("a\"b\\c\n"), R"("a\"b\\c\n")");
  EXPECT_EQ(json_line(std::string("\xff")), "\"\xef\xbf\xbd\"");
}

TEST(JsonLines, PutsEachItemOnAnIndentedLine) {
  EXPECT_EQ(json_lines({"1", "2"}, 2), "\n  1,\n  2");
  EXPECT_EQ(json_lines({}, 2), "");
}

}  // namespace
}  // namespace dismantle
