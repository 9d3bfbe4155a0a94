// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/check_report.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <limits>
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

PairStates four_states() {
  const auto id = [](std::uint32_t i) { return ComponentId(i); };
  PairStates states;
  states.tolerance = 0.01;
  states.pairs = {{id(0), id(1), PairState::Contact, 0, 0.004, 0.01, 148},
                  {id(0), id(2), PairState::Fit, 0, 0.1, 0.11, 12},
                  {id(0), id(3), PairState::Near, 0.05, 0, 0.01, 0},
                  {id(1), id(2), PairState::Embedded, 0, 2.5, std::numeric_limits<double>::infinity(), 7},
                  {id(2), id(3), PairState::Fit, 0, 0.3, 0.31, 3}};
  return states;
}

TEST(CheckReportJson, HasTheDocumentedMembers) {
  const auto json = nlohmann::ordered_json::parse(check_report_json(four_boxes(), four_states()));
  const auto keys = [](const nlohmann::ordered_json& object) {
    std::vector<std::string> names;
    for (const auto& [key, value] : object.items()) names.push_back(key);
    return names;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(keys(json), (Names{"format", "version", "assembly", "tolerance_mm", "pairs"}));
  EXPECT_EQ(json["format"], "dismantle-check");
  EXPECT_EQ(json["version"], 1);
  EXPECT_EQ(keys(json["assembly"]), (Names{"file", "components", "triangles"}));
  EXPECT_EQ(json["assembly"]["file"], "press.step");
  EXPECT_EQ(json["assembly"]["components"], 4);
  EXPECT_EQ(json["assembly"]["triangles"], 48);
  EXPECT_EQ(json["tolerance_mm"], 0.01);
  ASSERT_EQ(json["pairs"].size(), 5u);
  EXPECT_EQ(keys(json["pairs"][0]), (Names{"a", "b", "state", "distance_mm", "penetration_mm", "triangle_pairs"}));
  EXPECT_EQ(json["pairs"][0]["b"], "pin \"A\"");
  EXPECT_EQ(json["pairs"][1]["b"], "Büchse");
  EXPECT_EQ(json["pairs"][1]["state"], "fit");
  EXPECT_EQ(json["pairs"][1]["penetration_mm"], 0.1);
  EXPECT_EQ(json["pairs"][2]["state"], "near");
  EXPECT_EQ(json["pairs"][2]["distance_mm"], 0.05);
  EXPECT_EQ(json["pairs"][3]["state"], "embedded");
  EXPECT_EQ(json["pairs"][3]["triangle_pairs"], 7);
}

TEST(CheckReportJson, IsValidWithoutPairsAndWithNamesThatAreNotUtf8) {
  Assembly assembly = four_boxes();
  EXPECT_EQ(nlohmann::json::parse(check_report_json(assembly, {}))["pairs"].size(), 0u);
  assembly.components[0].name = "plate\xff";
  EXPECT_TRUE(nlohmann::json::accept(check_report_json(assembly, four_states())));
}

TEST(WorstFirst, PutsTheDeepestEmbeddedPairFirstAndTheFarthestNearPairLast) {
  const std::vector<ComponentPair> pairs = worst_first(four_states());
  ASSERT_EQ(pairs.size(), 5u);
  EXPECT_EQ(pairs[0].state, PairState::Embedded);
  EXPECT_EQ(pairs[1].penetration, 0.3);
  EXPECT_EQ(pairs[2].penetration, 0.1);
  EXPECT_EQ(pairs[3].state, PairState::Contact);
  EXPECT_EQ(pairs[4].state, PairState::Near);
}

TEST(CheckReportText, HasASummaryAndARowForEachPair) {
  const std::string text = check_report_text(four_boxes(), four_states());
  EXPECT_NE(text.find("press.step: 4 components, 48 triangles, tolerance 0.01 mm\n"), std::string::npos) << text;
  EXPECT_NE(text.find("1 embedded, 2 fit, 1 contact, 1 near\n"), std::string::npos) << text;
  EXPECT_LT(text.find("2.5"), text.find("0.31"));
  EXPECT_NE(text.find("pin \"A\""), std::string::npos);
  EXPECT_EQ(count_pairs(four_states()), (PairCounts{1, 1, 2, 1}));
}

TEST(CheckReportText, ColumnsLineUpDespiteUmlauts) {
  Assembly assembly = four_boxes();
  const std::string text = check_report_text(assembly, four_states());
  // The last column starts at the same character in the rows of "Büchse" (a) and "plate" (a).
  const auto column_of = [&](const std::string& start, const std::string& last) {
    const std::size_t line = text.find(start), place = text.find(last, line);
    std::size_t characters = 0;
    for (std::size_t i = line; i < place; ++i) characters += (static_cast<unsigned char>(text[i]) & 0xC0) != 0x80;
    return characters;
  };
  EXPECT_EQ(column_of("fit       0.3", "cap"), column_of("fit       0.1", "Büchse"));
}

TEST(CheckReportText, IsOnlyASummaryIfNoPairIsListed) {
  const std::string text = check_report_text(four_boxes(), {0.5, {}});
  EXPECT_NE(text.find("0 embedded, 0 fit, 0 contact, 0 near\n"), std::string::npos);
  EXPECT_EQ(text.find("depth"), std::string::npos);
}

}  // namespace
}  // namespace dismantle
