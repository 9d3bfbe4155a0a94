// SPDX-License-Identifier: Apache-2.0
#include "dismantle/fasteners/fastener_names.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

using Kind = Fastener::Kind;

/// "screw 5x16": what a name says.
std::string said(std::string_view name) {
  const FastenerName n = read_fastener_name(name);
  std::string text = n.is_other ? "other" : n.kind ? kind_name(*n.kind) : "nothing";
  char size[32] = "";
  if (n.diameter > 0) std::snprintf(size, sizeof size, " %gx%g", n.diameter, n.length);
  return text + size;
}

TEST(FastenerNames, AreReadInSeveralLanguages) {
  EXPECT_EQ(said("lid screw M6x22#3"), "screw 6x22");
  EXPECT_EQ(said("M3x10 SHCS"), "screw 3x10");
  EXPECT_EQ(said("Zylinderschraube M5 x 16"), "screw 5x16");
  EXPECT_EQ(said("六角ボルト M8×30"), "screw 8x30");
  EXPECT_EQ(said("M12Nut.M12Nut"), "nut 12x0");
  EXPECT_EQ(said("Sechskantmutter ISO 4032"), "nut");
  EXPECT_EQ(said("M4 平座金"), "washer 4x0");
  EXPECT_EQ(said("Unterlegscheibe M6"), "washer 6x0");
  EXPECT_EQ(said("DowellGrooved-10"), "dowel");
  EXPECT_EQ(said("dowel 8x26"), "dowel 8x26");
  EXPECT_EQ(said("ノックピン 6x20"), "dowel 6x20");
  EXPECT_EQ(said("circlip 11"), "circlip 11x0");
  EXPECT_EQ(said("snap ring 20"), "circlip 20x0");
  EXPECT_EQ(said("M3 Threaded Insert"), "insert 3x0");
  EXPECT_EQ(said("core insert"), "nothing") << "of a mould";
  EXPECT_EQ(said("Standoff_16 v1"), "standoff");
  EXPECT_EQ(said("M8x1x30 bolt"), "screw 8x30") << "a fine pitch";
}

TEST(FastenerNames, KnowStandards) {
  const FastenerName cap = read_fastener_name("DIN 912 M6x20"), pan = read_fastener_name("BS EN ISO 7045 - M2 x 4 - Z");
  EXPECT_EQ(cap.kind, Kind::Screw);
  EXPECT_EQ(cap.drive, Fastener::Drive::HexSocket);
  EXPECT_EQ(pan.head, Fastener::Head::Button);
  EXPECT_EQ(pan.drive, Fastener::Drive::Cross);
  EXPECT_EQ(pan.length, 4);
  EXPECT_EQ(read_fastener_name("ISO 7089 - 5").kind, Kind::Washer);
}

TEST(FastenerNames, TellOtherPartsApart) {
  for (const char* name : {"lead screw bracket", "ball screw", "nut holder", "bolt plate", "front bearing roller"})
    EXPECT_TRUE(read_fastener_name(name).is_other) << name;
  EXPECT_EQ(said("cross nut dowel"), "dowel") << "the last word counts";
  EXPECT_EQ(said("300-TableCage-1_321-Dowel-3"), "dowel") << "words that are not next to it do not";
  EXPECT_EQ(said("plate 5mm x 3"), "other");
  EXPECT_EQ(said(""), "nothing");
  EXPECT_EQ(said("M"), "nothing");
  EXPECT_EQ(said("M999999999999999999999x"), "nothing");
}

}  // namespace
}  // namespace dismantle
