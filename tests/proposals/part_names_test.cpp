// SPDX-License-Identifier: Apache-2.0
#include "dismantle/proposals/part_names.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

TEST(PartNames, AreDividedIntoWords) {
  EXPECT_EQ(words_of("SG90 - Micro Servo_9g.1"), (std::vector<std::string>{"sg90", "micro", "servo", "9g", "1"}));
  EXPECT_EQ(words_of("BatteryHolder v3"), (std::vector<std::string>{"battery", "holder", "v3"}));
  EXPECT_EQ(words_of("Kugellager Größe 2"), (std::vector<std::string>{"kugellager", "größe", "2"}));
  EXPECT_TRUE(words_of(" -_").empty());
}

TEST(PartNames, TellWhatIsPurchased) {
  EXPECT_EQ(purchased_word("25ga-370-280-rpm-dc Motor v1"), "motor");
  EXPECT_EQ(purchased_word("608 BEARING"), "bearing");
  EXPECT_EQ(purchased_word("NEMA17-stepper"), "nema17");
  EXPECT_EQ(purchased_word("MGN12H carriage"), "mgn12h");
  EXPECT_EQ(purchased_word("Load cell 5kg"), "load cell");
  EXPECT_EQ(purchased_word("BatteryHolder v3"), "battery");
  for (const char* other : {"motor mount", "Bearing_Housing", "Fan cover", "PCB spacer", "usb-plate", "Left panel", "",
                            "promotor", "headerless"})
    EXPECT_EQ(purchased_word(other), "") << other;
}

TEST(PartNames, TellWhatGives) {
  EXPECT_EQ(flexible_word("O-Ring 12x2"), "o-ring");
  EXPECT_EQ(flexible_word("oring_8mm"), "oring");
  EXPECT_EQ(flexible_word("DIN 471 Circlip"), "circlip");
  EXPECT_EQ(flexible_word("Retaining Ring A10"), "retaining ring");
  EXPECT_EQ(flexible_word("MotorBelt6GT3"), "belt6gt3");
  EXPECT_EQ(flexible_word("USB cable"), "cable");
  for (const char* other : {"Cable_Cover", "BeltTensioner", "spring pin", "ring", "sealing bolt", "E"})
    EXPECT_EQ(flexible_word(other), "") << other;
}

}  // namespace
}  // namespace dismantle
