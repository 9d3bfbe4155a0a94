// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/text_scan.h"

#include <gtest/gtest.h>

#include <clocale>
#include <limits>

namespace dismantle {

TEST(TextScan, ReadsNumbers) {
  EXPECT_EQ(to_double("1.5"), 1.5);
  EXPECT_EQ(to_double("+2e3"), 2000.0);
  EXPECT_EQ(to_double("-.5"), -0.5);
  EXPECT_EQ(to_double("0.1"), 0.1);
  EXPECT_EQ(to_integer("+7"), 7);
  EXPECT_EQ(to_integer("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
}

TEST(TextScan, RefusesNonFiniteNumbers) {
  for (const char* word : {"", "-", "+", "+-1", "1,5", "1.5x", "0x10", "nan", "inf", "-inf", "1e400", "1#INF", "e5"})
    EXPECT_EQ(to_double(word), std::nullopt) << word;
  for (const char* word : {"", "1.0", "9223372036854775808", "1a", "--1"})
    EXPECT_EQ(to_integer(word), std::nullopt) << word;
}

TEST(TextScan, ReadsUnderflowAsZeroAndKeepsSubnormals) {
  EXPECT_EQ(to_double("1e-400"), 0.0);
  EXPECT_EQ(to_double("4.9e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(to_double("0." + std::string(400, '0') + "1"), 0.0);
  EXPECT_EQ(to_double("1" + std::string(400, '0')), std::nullopt);
}

TEST(TextScan, DoesNotDependOnTheLocale) {
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) GTEST_SKIP() << "no German locale here";
  EXPECT_EQ(to_double("1.5"), 1.5);
  std::setlocale(LC_ALL, "C");
}

TEST(TextScan, SplitsALineIntoWords) {
  std::string_view rest = " \ta  bc\r";
  EXPECT_EQ(take_word(rest), "a");
  EXPECT_EQ(take_word(rest), "bc");
  EXPECT_EQ(take_word(rest), "");
}

TEST(TextScan, GivesLinesOfBothKinds) {
  LineReader lines("a\r\n\nb");
  EXPECT_EQ(lines.next(), "a");
  EXPECT_EQ(lines.next(), "");
  EXPECT_EQ(lines.next(), "b");
  EXPECT_EQ(lines.line(), 3u);
  EXPECT_EQ(lines.next(), std::nullopt);
}

TEST(TextScan, SkipsAByteOrderMark) {
  EXPECT_EQ(LineReader("\xef\xbb\xbfply\n").next(), "ply");
  EXPECT_EQ(WordReader("\xef\xbb\xbfsolid").next(), "solid");
}

TEST(TextScan, JoinsContinuedLines) {
  LineReader lines("f 1 \\\n2\\\r\n3\nnext\nlast\\");
  EXPECT_EQ(lines.next_joined(), "f 1  2 3");
  EXPECT_EQ(lines.line(), 3u);
  EXPECT_EQ(lines.next_joined(), "next");
  EXPECT_EQ(lines.next_joined(), "last ");
  EXPECT_EQ(lines.next_joined(), std::nullopt);
}

TEST(TextScan, GivesWordsAcrossLines) {
  WordReader words("solid my part \n facet");
  EXPECT_EQ(words.next(), "solid");
  EXPECT_EQ(words.rest_of_line(), "my part");
  EXPECT_EQ(words.next(), "facet");
  EXPECT_EQ(words.line(), 2u);
  EXPECT_EQ(words.next(), "");
}

}  // namespace dismantle
