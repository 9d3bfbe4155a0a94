// SPDX-License-Identifier: Apache-2.0
#include "dismantle/loading/estimated_deflection.h"

#include "dismantle/formats/import/import_options.h"
#include "dismantle/loading/load_assembly.h"
#include "dismantle/loading/write_assembly.h"
#include "tests/support/meshes.h"
#include "tests/support/parse_expectations.h"
#include "tests/support/scratch_folder.h"

#include <cmath>
#include <fstream>
#include <numbers>

namespace dismantle {
namespace {

/// The height of the arcs of a cylinder above the chords of its facets.
double height_of(double radius, int sides) {
  return radius * (1 - std::cos(std::numbers::pi / sides));
}

/// Far from all else: assemblies with it are large.
Component far_block() {
  return scenes::component("far", scenes::box({9000, 9000, 9000}, {9100, 9100, 9100}));
}

Assembly with_far_block(TriangleMesh mesh) {
  return scenes::assembly({scenes::component("part", std::move(mesh)), far_block()});
}

TEST(EstimatedDeflection, IsTwiceTheHeightOfFacetsUnderTheirCylinder) {
  for (const std::uint32_t sides : {16u, 48u, 200u})
    for (const double radius : {0.5, 3.0}) {
      const double height = height_of(radius, static_cast<int>(sides));
      const double found = estimated_deflection(with_far_block(scenes::tube(radius, 0, -2, 5, sides, 3)));
      EXPECT_NEAR(found, 2 * height, 0.02 * 2 * height) << sides << " sides, radius " << radius;
    }
}

TEST(EstimatedDeflection, IsThatOfTheCoarsestCylinderOfImportance) {
  TriangleMesh fine = scenes::tube(3, 0, -2, 5, 200), coarse = scenes::tube(3, 0, -2, 5, 24);
  const Assembly both =
      scenes::assembly({scenes::component("fine", fine), scenes::component("coarse", coarse), far_block()});
  EXPECT_NEAR(estimated_deflection(both), 2 * height_of(3, 24), 0.03 * 2 * height_of(3, 24));
}

TEST(EstimatedDeflection, OfFlatFacesIsZero) {
  EXPECT_EQ(estimated_deflection(with_far_block(scenes::box({0, 0, 0}, {1, 2, 3}))), 0);
  // A prism: its edges are meant.
  EXPECT_EQ(estimated_deflection(with_far_block(scenes::tube(3, 0, -2, 5, 8))), 0);
  EXPECT_EQ(estimated_deflection(scenes::assembly({})), 0);
}

TEST(EstimatedDeflection, IsNoMoreThanThatOfCadFiles) {
  const Assembly alone = scenes::assembly({scenes::component("part", scenes::tube(3, 0, -2, 5, 16))});
  EXPECT_EQ(estimated_deflection(alone), kDefaultRelativeDeflection * diagonal(assembled_bounds(alone)));
}

TEST(EstimatedDeflection, CountsWhereAReaderKnowsOnlyThatOfPrimitives) {
  const ScratchFolder folder;
  const Assembly mesh = with_far_block(scenes::tube(3, 0, -2, 5, 24));
  ASSERT_TRUE(write_assembly(folder / "part.obj", mesh).ok());
  std::ofstream(folder / "robot.urdf") << R"(<robot name="r"><link name="l">
    <visual><geometry><mesh filename="part.obj" scale="0.001 0.001 0.001"/></geometry></visual>
    <visual><geometry><sphere radius="0.0001"/></geometry></visual></link></robot>)";
  const auto robot = load_assembly(folder / "robot.urdf");
  ASSERT_TRUE(robot.ok()) << message_of(robot);
  EXPECT_TRUE(robot->deflection_is_estimated);
  EXPECT_NEAR(robot->deflection, 2 * height_of(3, 24), 0.03 * 2 * height_of(3, 24));
}

TEST(EstimatedDeflection, OfTheMeshesOfACadFileIsThatOfTheFile) {
  for (const char* sample : {"tooling", "robot"}) {
    const auto from_cad = load_assembly(std::string(DISMANTLE_SOURCE_DIR "/samples/") + sample + ".step");
    ASSERT_TRUE(from_cad.ok()) << message_of(from_cad);
    EXPECT_NEAR(estimated_deflection(*from_cad), from_cad->deflection, 0.05 * from_cad->deflection) << sample;
    const ScratchFolder folder;
    ASSERT_TRUE(write_assembly(folder / "meshes", *from_cad).ok());
    const auto from_meshes = load_assembly(folder / "meshes");
    ASSERT_TRUE(from_meshes.ok()) << message_of(from_meshes);
    EXPECT_FALSE(from_cad->deflection_is_estimated);
    EXPECT_TRUE(from_meshes->deflection_is_estimated);
    EXPECT_NEAR(default_tolerance(*from_meshes), default_tolerance(*from_cad), 0.05 * default_tolerance(*from_cad));
  }
}

}  // namespace
}  // namespace dismantle
