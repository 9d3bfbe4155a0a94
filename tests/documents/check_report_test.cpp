// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/check_report.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace dismantle {
namespace {

Assembly four_boxes() {
  Assembly a = scenes::assembly({scenes::component("plate", scenes::box({0, 0, 0}, {9, 9, 1})),
                                 scenes::component("pin \"A\"", scenes::box({1, 1, 0}, {2, 2, 5})),
                                 scenes::component("Büchse", scenes::box({3, 3, 0}, {4, 4, 5})),
                                 scenes::component("cap", scenes::box({5, 5, 1.05}, {6, 6, 2}))});
  a.source_file = "press.step";
  return a;
}

Clashes five_clashes() {
  const auto id = [](std::uint32_t i) { return ComponentId(i); };
  Clashes clashes;
  clashes.tolerance = 0.01;
  clashes.pairs = {{id(0), id(1), ClashState::Contact, {}, 0, 0.004, 0.004, {1, 2, 3}, 0, 0, false},
                   {id(0), id(2), ClashState::Overlapping, {}, 0, 0.1, 0.1, {3, 4, 1}, 0.5, 0.004, false},
                   {id(0), id(3), ClashState::Near, {}, 0.05, 0, 0, {5, 5, 1}, 0, 0, false},
                   {id(1), id(2), ClashState::Overlapping, id(2), 0, 2.5, 2.49, {1.5, 1.5, 2}, 12, 0.1, false},
                   {id(2), id(3), ClashState::Overlapping, {}, 0, 0.3, 0.1, {4, 4, 4}, 3, 0.02, true}};
  return clashes;
}

TEST(CheckReportJson, HasTheDocumentedMembers) {
  const auto json = nlohmann::ordered_json::parse(check_report_json(four_boxes(), five_clashes()));
  const auto keys = [](const nlohmann::ordered_json& object) {
    std::vector<std::string> names;
    for (const auto& [key, value] : object.items()) names.push_back(key);
    return names;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(keys(json), (Names{"format", "version", "assembly", "tolerance_mm", "pairs"}));
  EXPECT_EQ(json["format"], "dismantle-check");
  EXPECT_EQ(json["version"], 2);
  EXPECT_EQ(keys(json["assembly"]), (Names{"file", "components", "triangles"}));
  EXPECT_EQ(json["assembly"]["file"], "press.step");
  EXPECT_EQ(json["assembly"]["components"], 4);
  EXPECT_EQ(json["assembly"]["triangles"], 48);
  EXPECT_EQ(json["tolerance_mm"], 0.01);
  ASSERT_EQ(json["pairs"].size(), 5u);
  EXPECT_EQ(keys(json["pairs"][0]), (Names{"a", "b", "state", "distance_mm", "depth_mm", "deepest_at", "volume_mm3"}));
  EXPECT_EQ(json["pairs"][0]["b"], "pin \"A\"");
  EXPECT_EQ(json["pairs"][0]["state"], "contact");
  EXPECT_EQ(json["pairs"][0]["deepest_at"], (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(json["pairs"][1]["b"], "Büchse");
  EXPECT_EQ(json["pairs"][1]["state"], "overlapping");
  EXPECT_EQ(json["pairs"][1]["depth_mm"], 0.1);
  EXPECT_EQ(json["pairs"][1]["volume_mm3"], 0.5);
  EXPECT_EQ(json["pairs"][2]["state"], "near");
  EXPECT_EQ(json["pairs"][2]["distance_mm"], 0.05);
  EXPECT_EQ(json["pairs"][3]["contained"], true);
  EXPECT_EQ(json["pairs"][4]["depth_at_least_mm"], 0.1);
}

TEST(CheckReportJson, IsValidWithoutPairsAndWithNamesThatAreNotUtf8) {
  Assembly assembly = four_boxes();
  EXPECT_EQ(nlohmann::json::parse(check_report_json(assembly, {}))["pairs"].size(), 0u);
  assembly.components[0].name = "plate\xff";
  EXPECT_TRUE(nlohmann::json::accept(check_report_json(assembly, five_clashes())));
}

TEST(WorstFirst, PutsTheDeepestPairFirstAndTheFarthestNearPairLast) {
  const std::vector<Clash> pairs = worst_first(five_clashes());
  ASSERT_EQ(pairs.size(), 5u);
  EXPECT_EQ(pairs[0].depth, 2.5);
  EXPECT_EQ(pairs[1].depth, 0.3);
  EXPECT_EQ(pairs[2].depth, 0.1);
  EXPECT_EQ(pairs[3].state, ClashState::Contact);
  EXPECT_EQ(pairs[4].state, ClashState::Near);
}

TEST(CheckReportText, HasASummaryAndARowForEachPair) {
  const std::string text = check_report_text(four_boxes(), five_clashes());
  EXPECT_NE(text.find("press.step: 4 components, 48 triangles, tolerance 0.01 mm\n"), std::string::npos) << text;
  EXPECT_NE(text.find("3 overlapping, 1 of them one inside the other, 1 contact, 1 near\n"), std::string::npos) << text;
  EXPECT_LT(text.find("2.5"), text.find("up to 0.3"));
  EXPECT_NE(text.find("pin \"A\""), std::string::npos);
  EXPECT_NE(text.find("Büchse (inside)"), std::string::npos);
  EXPECT_NE(text.find("1.50 1.50 2.00"), std::string::npos);
  EXPECT_EQ(count_clashes(five_clashes()), (ClashCounts{1, 1, 3, 1}));
}

TEST(DepthText, IsZeroWhereNothingIsDeeperThanTheBoundIsAccurate) {
  Clash clash;
  clash.depth = 0.0009;
  EXPECT_EQ(depth_text(clash, 0.01), "0");
  EXPECT_EQ(depth_text(clash, 0.001), "0.0009");
  clash.depth_loose = true;
  EXPECT_EQ(depth_text(clash, 0.001), "up to 0.0009");
}

TEST(CheckReportText, HasNoDigitsThatMeanNothing) {
  Clashes clashes = five_clashes();
  clashes.pairs[0].distance = 1.243e-14;
  clashes.pairs[1].volume = 3.1e-13;
  clashes.pairs[2].distance = 0.0512345;
  const std::string text = check_report_text(four_boxes(), clashes);
  EXPECT_EQ(text.find("e-"), std::string::npos) << text;
  EXPECT_NE(text.find(" 0.051 "), std::string::npos) << text;
}

TEST(CheckReportText, ColumnsLineUpDespiteUmlauts) {
  Assembly assembly = four_boxes();
  const std::string text = check_report_text(assembly, five_clashes());
  // The last column starts at the same character in the rows of "Büchse" (a) and "plate" (a).
  const auto column_of = [&](const std::string& start, const std::string& last) {
    const std::size_t line = text.find(start), place = text.find(last, line);
    std::size_t characters = 0;
    for (std::size_t i = line; i < place; ++i) characters += (static_cast<unsigned char>(text[i]) & 0xC0) != 0x80;
    return characters;
  };
  EXPECT_EQ(column_of("overlapping  up to 0.3", "cap"), column_of("overlapping  0.1", "Büchse"));
}

TEST(CheckReportText, IsOnlyASummaryIfNoPairIsListed) {
  const std::string text = check_report_text(four_boxes(), {0.5, {}});
  EXPECT_NE(text.find("0 overlapping, 0 contact, 0 near\n"), std::string::npos);
  EXPECT_EQ(text.find("depth"), std::string::npos);
}

}  // namespace
}  // namespace dismantle
