// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/number_text.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

TEST(NumberText, KeepsTheSignificantDigits) {
  EXPECT_EQ(number_text(0.66249, 3), "0.662");
  EXPECT_EQ(number_text(12.5, 4), "12.5");
  EXPECT_EQ(number_text(-1.99, 2), "-2");
  EXPECT_EQ(number_text(9.996, 3), "10");
  EXPECT_EQ(number_text(100, 3), "100");
}

TEST(NumberText, HasNoDigitBelowTheResolution) {
  EXPECT_EQ(number_text(1.243e-14, 4), "0");
  EXPECT_EQ(number_text(-1.243e-14, 4), "0");
  EXPECT_EQ(number_text(0.0014, 4, 0.01), "0");
  EXPECT_EQ(number_text(-0.0049, 4, 0.01), "0");
  EXPECT_EQ(number_text(0.0062, 4, 0.01), "0.01");
  EXPECT_EQ(number_text(12.3456, 6, 0.01), "12.35");
  EXPECT_EQ(number_text(0.0000004, 3), "0");
  EXPECT_EQ(number_text(0.0000123, 3), "0.000012");
}

TEST(NumberText, NeverHasAnExponent) {
  EXPECT_EQ(number_text(743384.0, 4), "743400");
  EXPECT_EQ(number_text(743384.4, 6), "743384");
  EXPECT_EQ(number_text(1e21, 3), "1000000000000000000000");
  EXPECT_EQ(number_text(0, 3), "0");
  EXPECT_EQ(number_text(-0.0, 3), "0");
}

}  // namespace
}  // namespace dismantle
