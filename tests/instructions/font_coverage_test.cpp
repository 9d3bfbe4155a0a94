// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/font_coverage.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

/// A private use character, which no font has.
constexpr const char* kNowhere = "\U0010FFFD";

TEST(FontCoverage, HasLatinAccentsGreekAndCyrillic) {
  const FontCoverage fonts;
  EXPECT_EQ(fonts.missing("Büchse M3×8 – \u0436 \u03a9 łącznik"), "");
  EXPECT_EQ(fonts.drawable("Büchse"), "Büchse");
}

TEST(FontCoverage, NamesEachMissingCharacterOnce) {
  const FontCoverage fonts;
  const std::string text = std::string("a") + kNowhere + "b" + kNowhere;
  EXPECT_EQ(fonts.missing(text), kNowhere);
  EXPECT_EQ(fonts.drawable(text), "a\uFFFDb\uFFFD");
  EXPECT_EQ(fonts.missing(text), kNowhere) << "asked again";
}

TEST(FontCoverage, TakesBytesThatAreNoText) {
  const FontCoverage fonts;
  EXPECT_EQ(fonts.drawable("a\xff"), "a\uFFFD");
  EXPECT_EQ(fonts.missing(""), "");
}

}  // namespace
}  // namespace dismantle
