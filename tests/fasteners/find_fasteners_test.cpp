// SPDX-License-Identifier: Apache-2.0
#include "dismantle/fasteners/find_fasteners.h"

#include "tests/fasteners/turned_meshes.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

using Kind = Fastener::Kind;

std::string text_of(const std::optional<Fastener>& f) {
  return f ? fastener_text(*f) : "nothing";
}

std::vector<std::string> found_in(const std::vector<std::pair<std::string, TriangleMesh>>& parts,
                                  FastenerEvidence evidence = FastenerEvidence::ShapeAndName) {
  std::vector<Component> components;
  for (const auto& [name, mesh] : parts) components.push_back(scenes::component(name, mesh));
  std::vector<std::string> texts;
  for (const auto& f : find_fasteners(scenes::assembly(std::move(components)), {}, evidence))
    texts.push_back(text_of(f));
  return texts;
}

TEST(FindFasteners, LetsNamesDecideWhatShapesLeaveOpen) {
  const TriangleMesh headed = scenes::screw(5, 20, scenes::circle(4), 3), pin = scenes::tube(4, 0, 0, 20, 48);
  EXPECT_EQ(found_in({{"part 1", headed}, {"bolt", headed}, {"rivet", headed}, {"ejector", headed}}),
            (std::vector<std::string>{"nothing", "cylinder head screw M5x20", "rivet 5x20", "nothing"}));
  EXPECT_EQ(found_in({{"part 1", pin}, {"roller", pin}, {"set screw M8x20", pin}, {"cross screw", pin}}),
            (std::vector<std::string>{"dowel 8x20", "nothing", "set screw M8x20", "dowel 8x20"}));
  EXPECT_EQ(found_in({{"bolt", headed}, {"roller", pin}}, FastenerEvidence::ShapeOnly),
            (std::vector<std::string>{"nothing", "dowel 8x20"}));
}

TEST(FindFasteners, IgnoresWhatAllNamesBeginWith) {
  const TriangleMesh block = scenes::tube(60, 20, 0, 40, 48);
  EXPECT_EQ(found_in({{"BoltsAndNuts_-_Pump", block}, {"BoltsAndNuts_-_Lid", block}, {"BoltsAndNuts_-_Ring", block}}),
            (std::vector<std::string>{"nothing", "nothing", "nothing"}));
}

TEST(FindFasteners, CountsEqualOnes) {
  const TriangleMesh five = scenes::screw(5, 16, scenes::circle(4.25), 5, scenes::hexagon(4), 2.5);
  const TriangleMesh three = scenes::screw(3, 8, scenes::circle(2.75), 3, scenes::hexagon(2.5), 1.5);
  const Pose pose{{40, 5, -3}, normalized(Quat{0.3, -0.2, 0.7, 0.1})};
  Assembly assembly =
      scenes::assembly({scenes::component("a", five), scenes::component("b", scenes::box({0, 0, 0}, {9, 9, 9})),
                        scenes::component("c", three), scenes::component("d", scenes::moved(five, pose))});
  const std::vector<CountedFastener> counted = counted_fasteners(find_fasteners(assembly));
  ASSERT_EQ(counted.size(), 2u);
  EXPECT_EQ(fastener_text(counted[0].fastener), "socket head screw M3x8");
  EXPECT_EQ(counted[1].components, (std::vector<ComponentId>{ComponentId(0), ComponentId(3)}));
  EXPECT_EQ(counted[1].fastener.pitch, 0.8);
}

TEST(FastenerTexts, NameKindSizeAndTool) {
  Fastener f;
  f.head = Fastener::Head::Button;
  f.drive = Fastener::Drive::Cross;
  f.diameter = 2.5;
  f.length = 6;
  f.drive_size = 1;
  EXPECT_EQ(fastener_text(f), "pan head screw M2.5x6");
  EXPECT_EQ(tool_text(f), "Phillips screwdriver PH1");
  f = {};
  f.kind = Kind::Nut;
  EXPECT_EQ(fastener_text(f), "nut") << "of unknown size";
  EXPECT_EQ(tool_text(f), "");
}

}  // namespace
}  // namespace dismantle
