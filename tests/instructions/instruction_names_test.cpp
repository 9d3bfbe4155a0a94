// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/instruction_names.h"

#include "tests/instructions/bolted_lid.h"

namespace dismantle {
namespace {

/// Finds "\u5438" and "\u7740" missing.
std::string without_two(const std::string& text) {
  std::string missing;
  for (const char* character : {"\u5438", "\u7740"})
    if (text.find(character) != std::string::npos) missing += character;
  return missing;
}

class InstructionNamesTest : public testing::Test {
 protected:
  /// Names of base, lid, bolt and bolt#2.
  void name(const std::string& base, const std::string& lid, const std::string& bolt) {
    assembly.components[0].name = base;
    assembly.components[1].name = lid;
    assembly.components[2].name = bolt;
    assembly.components[3].name = bolt + "#2";
    bill = bill_of_materials(assembly);
  }

  Assembly assembly = scenes::bolted_lid();
  std::vector<BillItem> bill;
};

TEST_F(InstructionNamesTest, KeepsShortNames) {
  name("base", "lid", "bolt");
  const InstructionNames names(assembly, bill, without_two);
  EXPECT_EQ(names.of(ComponentId(3)), "bolt#2");
  EXPECT_EQ(names.in_title(ComponentId(3)), "bolt#2");
  EXPECT_EQ(names.item_in_title(2), "bolt");
  EXPECT_EQ(names.missing(), "");
}

TEST_F(InstructionNamesTest, ShortensLongNamesInTitlesAndNumbersThemInText) {
  const std::string longest = "B18.3.1M - 10 x 1.5 x 60 Hex SHCS -- 60NHX";
  name(longest, "lid", "b\u00fc" + longest);
  const InstructionNames names(assembly, bill, {});
  EXPECT_EQ(names.of(ComponentId(0)), "item 1");
  EXPECT_EQ(names.in_title(ComponentId(0)), "B18.3.1M - 10 x 1.5 \u2026HCS -- 60NHX (item 1)");
  EXPECT_EQ(names.item_in_title(2), "b\u00fcB18.3.1M - 10 x 1.\u2026HCS -- 60NHX (item 3)");
  EXPECT_EQ(names.in_list(0), longest);
}

TEST_F(InstructionNamesTest, AddsTheNumberInTextWhereItemsHaveOneName) {
  name("part", "part#2", "bolt");
  const InstructionNames names(assembly, bill, {});
  ASSERT_EQ(bill[1].name, "part");
  EXPECT_EQ(names.of(ComponentId(0)), "part (item 1)");
  EXPECT_EQ(names.of(ComponentId(1)), "part#2 (item 2)");
  EXPECT_EQ(names.of_item(1), "part (item 2)");
  EXPECT_EQ(names.in_title(ComponentId(1)), "part#2");
  EXPECT_EQ(names.of(ComponentId(3)), "bolt#2");
}

TEST_F(InstructionNamesTest, NumbersWhatCannotBeShown) {
  name("\u5438\u7740\u5438", "lid", "\u7740");
  const InstructionNames names(assembly, bill, without_two);
  EXPECT_EQ(names.of(ComponentId(0)), "item 1");
  EXPECT_EQ(names.in_title(ComponentId(0)), "item 1");
  EXPECT_EQ(names.in_list(0), "item 1");
  EXPECT_EQ(names.of(ComponentId(1)), "lid");
  EXPECT_EQ(names.of_body("\u5438"), "");
  EXPECT_EQ(names.missing(), "\u5438\u7740");
}

TEST(ListText, CountsWhatItDoesNotName) {
  EXPECT_EQ(list_text({"a"}), "a");
  EXPECT_EQ(list_text({"a", "b", "c"}), "a, b and c");
  EXPECT_EQ(list_text({"a", "b", "c", "d", "e", "f", "g"}), "a, b, c, d, e and 2 more");
}

}  // namespace
}  // namespace dismantle
