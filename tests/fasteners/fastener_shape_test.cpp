// SPDX-License-Identifier: Apache-2.0
#include "dismantle/fasteners/fastener_shape.h"

#include "tests/fasteners/turned_meshes.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <random>

namespace dismantle {
namespace {

using scenes::circle;
using scenes::hexagon;
using scenes::lobes;
using scenes::screw;
using scenes::turned;

/// What the most certain reading of a mesh is, in words, in several poses; all of them must agree.
std::string read(const TriangleMesh& mesh) {
  std::mt19937 random(20261125);
  std::normal_distribution<double> normal;
  std::string text;
  for (int i = 0; i < 4; ++i) {
    const Quat turn =
        i == 0 ? Quat{} : normalized(Quat{normal(random), normal(random), normal(random), normal(random)});
    const std::vector<FastenerShape> found = fastener_shapes(scenes::moved(mesh, {{3.0 * i, -7.0 * i, 11}, turn}));
    std::string now = "nothing";
    if (!found.empty() && found.front().certainty != FastenerShape::Certainty::Possible) {
      const std::string tool = tool_text(found.front().fastener);
      now = fastener_text(found.front().fastener) + (tool.empty() ? "" : ", " + tool);
    }
    EXPECT_TRUE(i == 0 || now == text) << now << " in another pose, " << text << " before";
    text = now;
  }
  return text;
}

TEST(FastenerShape, TellsScrewsByHeadAndDrive) {
  EXPECT_EQ(read(screw(5, 16, circle(4.25), 5, hexagon(4), 2.5)), "socket head screw M5x16, 4 mm hex key");
  EXPECT_EQ(read(screw(8, 30, hexagon(13), 5.3)), "hexagon head screw M8x30, 13 mm spanner (wrench)");
  EXPECT_EQ(read(screw(4, 12, circle(3.5), 2.6, lobes(0.9, 2.2, 4), 1.5)),
            "cylinder head screw M4x12, Phillips screwdriver PH2");
  EXPECT_EQ(read(screw(6, 20, circle(5), 6, lobes(1.95, 2.8, 6), 3)), "cylinder head screw M6x20, Torx key T30");
}

TEST(FastenerShape, MeasuresCountersunkScrewsOverAll) {
  EXPECT_EQ(read(turned({{-12, circle(2.5)}, {-2.5, circle(2.5)}, {0, circle(5)}, {0, hexagon(3)}, {-2, hexagon(3)}})),
            "countersunk screw M5x12, 3 mm hex key");
}

TEST(FastenerShape, KnowsTheHeadOfAButton) {
  std::vector<scenes::Ring> rings{{-10, circle(1.5)}, {0, circle(1.5)}};
  for (int i = 0; i <= 8; ++i) {
    const double z = 1.65 * i / 8;
    rings.push_back({z, circle(1.2 + 1.65 * std::sqrt(1 - std::pow(z / 1.8, 2)))});
  }
  rings.push_back({1.65, hexagon(2)});
  rings.push_back({0.6, hexagon(2)});
  EXPECT_EQ(read(turned(rings)), "button head screw M3x10, 2 mm hex key");
}

TEST(FastenerShape, KnowsWhichWayAScrewPoints) {
  const Pose pose{{1, 2, 3}, normalized(Quat{0.1, 0.7, -0.3, 0.6})};
  const auto found = fastener_shapes(scenes::moved(screw(5, 16, circle(4.25), 5, hexagon(4), 2.5), pose));
  ASSERT_FALSE(found.empty());
  EXPECT_LT(length(found[0].fastener.axis - transform_from_pose(pose).rotation * Vec3{0, 0, 1}), 1e-3);
}

TEST(FastenerShape, KnowsSetScrewsByTheirSocket) {
  EXPECT_EQ(read(turned({{0, circle(2)}, {8, circle(2)}, {8, hexagon(2)}, {6, hexagon(2)}})),
            "set screw M4x8, 2 mm hex key");
}

TEST(FastenerShape, KnowsNutsAndStandoffs) {
  const auto hexagonal = [](double width, double hole, double height) {
    return turned({{0, hexagon(width)}, {height, hexagon(width)}, {height, circle(hole / 2)}, {0, circle(hole / 2)}},
                  false);
  };
  EXPECT_EQ(read(hexagonal(8, 5, 4)), "nut M5, 8 mm spanner (wrench)");
  EXPECT_EQ(read(hexagonal(13, 6.7, 6.5)), "nut M8, 13 mm spanner (wrench)") << "drawn with the root diameter";
  EXPECT_EQ(read(hexagonal(17, 10, 8)), "nut M10, 17 mm spanner (wrench)") << "DIN 934";
  EXPECT_EQ(read(hexagonal(5.5, 3, 15)), "standoff M3x15, 5.5 mm spanner (wrench)");
  EXPECT_EQ(read(turned({{-6, circle(1.5)},
                         {0, circle(1.5)},
                         {0, hexagon(5.5)},
                         {16, hexagon(5.5)},
                         {16, circle(1.25)},
                         {10, circle(1.25)}})),
            "standoff M3x16, 5.5 mm spanner (wrench)");
}

TEST(FastenerShape, KnowsWashersDowelsAndCirclips) {
  EXPECT_EQ(read(scenes::tube(3.5, 1.6, 0, 0.5, 48)), "washer M3");
  EXPECT_EQ(read(scenes::tube(4, 0, 0, 20, 48)), "dowel 8x20");
  EXPECT_EQ(read(scenes::tube(25.4 / 16, 0, 0, 25.4, 48)), "dowel 3.17x25.4") << "an eighth of an inch";
  // A ring with a gap of a sixth of a turn.
  TriangleMesh open;
  constexpr std::uint32_t kCuts = 40;
  for (std::uint32_t k = 0; k <= kCuts; ++k) {
    const double angle = kTurn * (1.0 / 12 + 5.0 / 6 * k / kCuts);
    for (const double r : {5.1, 6.6})
      for (const double z : {0.0, 1.0}) open.vertices.push_back({r * std::cos(angle), r * std::sin(angle), z});
  }
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    open.faces.push_back({{a, b, c}});
    open.faces.push_back({{a, c, d}});
  };
  for (std::uint32_t k = 0; k < kCuts; ++k) {
    const std::uint32_t i = 4 * k, n = i + 4;
    quad(i, i + 1, n + 1, n);
    quad(i + 2, n + 2, n + 3, i + 3);
    quad(i + 1, i + 3, n + 3, n + 1);
    quad(i, n, n + 2, i + 2);
  }
  quad(0, 2, 3, 1);
  quad(4 * kCuts, 4 * kCuts + 1, 4 * kCuts + 3, 4 * kCuts + 2);
  EXPECT_EQ(read(open), "circlip 11");
}

TEST(FastenerShape, LeavesOtherPartsAlone) {
  EXPECT_EQ(read(scenes::box({0, 0, 0}, {5, 5, 5})), "nothing");
  EXPECT_EQ(read(scenes::tube(10, 0, 0, 278, 64)), "nothing") << "a shaft";
  EXPECT_EQ(read(scenes::tube(4.7, 0, 0, 16.5, 64)), "nothing") << "a roller";
  EXPECT_EQ(read(scenes::tube(15, 10, 0, 20, 64)), "nothing") << "a bush";
  EXPECT_EQ(read(screw(6, 100, circle(5), 4)), "nothing") << "an ejector pin: no drive, no thread";
  EXPECT_EQ(read(turned(
                {{0, circle(8)}, {20, circle(8)}, {20, circle(13)}, {26, circle(13)}, {26, circle(6)}, {0, circle(6)}},
                false)),
            "nothing")
      << "a bush with a collar";
  EXPECT_EQ(read(turned({{0, lobes(8, 10, 20)}, {6, lobes(8, 10, 20)}, {6, circle(2.5)}, {0, circle(2.5)}}, false)),
            "nothing")
      << "a gear";
}

}  // namespace
}  // namespace dismantle
