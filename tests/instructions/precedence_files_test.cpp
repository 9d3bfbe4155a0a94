// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/precedence_files.h"

#include "tests/instructions/bolted_lid.h"

#include <nlohmann/json.hpp>

namespace dismantle {
namespace {

using Json = nlohmann::json;

/// The bolts and then the lid, as one subassembly that is disassembled afterwards.
Plan lid_with_bolts() {
  const auto step = [](std::vector<ComponentId> components, std::uint32_t part_of) {
    return PlanStep{std::move(components), PlanTier::Straight, part_of, {}, {0, 0, 1}};
  };
  Plan plan;
  plan.steps = {step({ComponentId(1), ComponentId(2), ComponentId(3)}, PlanStep::kWhole), step({ComponentId(2)}, 0),
                step({ComponentId(3)}, 0)};
  return plan;
}

const PrecedenceGraph kGraph{{{}, {0}, {0}}, {0, 1, 1}};

TEST(PrecedenceDot, HasANodeAStepAndAnEdgeForEachThatComesBefore) {
  const std::string dot = precedence_dot(scenes::bolted_lid(), lid_with_bolts(), kGraph);
  EXPECT_EQ(dot,
            "digraph precedence {\n  rankdir=LR;\n  node [shape=box];\n"
            "  s1 [label=\"1  lid and 2 more\"];\n  s2 [label=\"2  bolt\"];\n  s3 [label=\"3  bolt#2\"];\n"
            "  { rank=same; s1; }\n  { rank=same; s2; s3; }\n"
            "  s1 -> s2 [style=dashed];\n  s1 -> s3 [style=dashed];\n}\n");
}

TEST(PrecedenceJson, HasRanksAndTheTreeOfSubassemblies) {
  const Json json = Json::parse(precedence_json(scenes::bolted_lid(), lid_with_bolts(), kGraph));
  EXPECT_EQ(json["format"], "dismantle-precedence");
  EXPECT_EQ(json["steps"][2]["before"], Json({1}));
  EXPECT_EQ(json["steps"][2]["part_of_step"], 1);
  EXPECT_EQ(json["ranks"], Json({{1}, {2, 3}}));
  const Json& whole = json["subassemblies"];
  EXPECT_TRUE(whole["step"].is_null());
  EXPECT_EQ(whole["left"], Json({"base"}));
  EXPECT_EQ(whole["parts"][0]["step"], 1);
  EXPECT_EQ(whole["parts"][0]["parts"][1]["components"], Json({"bolt#2"}));
  EXPECT_EQ(whole["parts"][0]["left"], Json({"lid"}));
}

}  // namespace
}  // namespace dismantle
