// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/vrml/read_vrml.h"

#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dismantle {
namespace {

const double kPi = std::acos(-1.0);

/// A tetrahedron with edges of 10 along the axes; volume 1000/6.
const std::string kFaces =
    "IndexedFaceSet { coord Coordinate { point [ 0 0 0, 10 0 0, 0 10 0, 0 0 10 ] } "
    "coordIndex [ 0,2,1,-1 0 1 3 -1 0 3 2 -1 1 2 3 -1 ] }";

Result<Assembly> read_text(const std::string& body, const std::string& units = "mm",
                           std::size_t triangles = 50'000'000) {
  ImportOptions options;
  options.units = units;
  options.limits.triangles = triangles;
  options.limits.components = 1000;
  return import_vrml({"#VRML V2.0 utf8\n" + body, "a.wrl"}, options);
}

Assembly read(const std::string& body) {
  Result<Assembly> a = read_text(body);
  EXPECT_TRUE(a.ok()) << a.error().message;
  return a ? std::move(*a) : Assembly();
}

std::string error_of(const std::string& body) {
  const Result<Assembly> a = read_text(body);
  return a ? std::string() : a.error().message;
}

void expect_box(const Aabb& box, Vec3 lower, Vec3 upper) {
  EXPECT_LT(max_abs(box.lower - lower), 1e-9) << box.lower.x << " " << box.lower.y << " " << box.lower.z;
  EXPECT_LT(max_abs(box.upper - upper), 1e-9) << box.upper.x << " " << box.upper.y << " " << box.upper.z;
}

TEST(ReadVrml, MakesAComponentOfEachOccurrenceOfAShape) {
  const Assembly a =
      read("DEF arm Transform { translation 100 0 0 rotation 0 0 1 " + std::to_string(kPi / 2) +
           " children [ DEF tip Shape { geometry " + kFaces +
           " appearance Appearance { material DEF red Material { diffuseColor 1 0.5 0 } } } ] }\n"
           "Group { children USE tip }\nDEF m\xc3\xbc Shape { appearance Appearance { material USE red } "
           "geometry Box { size 2 4 6 } }");
  ASSERT_EQ(a.components.size(), 3u);
  EXPECT_EQ(a.components[0].name, "tip");
  EXPECT_EQ(a.components[1].name, "tip#2");
  EXPECT_EQ(a.components[2].name, "m\xc3\xbc");
  EXPECT_EQ(a.tree[a.tree[a.components[0].tree_node].parent].name, "arm");
  EXPECT_EQ(a.components[0].mesh, a.components[1].mesh);
  EXPECT_EQ(a.components[2].color, (Color{1, 0.5, 0, 1}));
  EXPECT_LT(max_abs(assembled_bounds(a.components[0]).lower - Vec3{90, 0, 0}), 1e-4);
  expect_box(assembled_bounds(a.components[1]), {0, 0, 0}, {10, 10, 10});
  expect_box(assembled_bounds(a.components[2]), {-1, -2, -3}, {1, 2, 3});
  for (const Component& c : a.components) EXPECT_TRUE(c.faults.bounds_solid());
  EXPECT_NEAR(signed_volume(*a.components[0].mesh), 1000.0 / 6, 1e-9);
}

TEST(ReadVrml, IsInMetresUnlessTheUserSaysOtherwise) {
  const Result<Assembly> metres = read_text("Shape { geometry Box { } }", "");
  ASSERT_TRUE(metres.ok());
  EXPECT_EQ(metres->source_units, "m");
  expect_box(assembled_bounds(*metres), {-1000, -1000, -1000}, {1000, 1000, 1000});
  const Result<Assembly> inches = read_text("Shape { geometry Box { } }", "in");
  ASSERT_TRUE(inches.ok());
  expect_box(assembled_bounds(*inches), {-25.4, -25.4, -25.4}, {25.4, 25.4, 25.4});
}

TEST(ReadVrml, MeshesSolidsAboutTheYAxis) {
  const Assembly a = read(
      "Shape { geometry Cylinder { radius 2 height 10 } } Shape { geometry Cone { bottomRadius 3 height 8 } } "
      "Shape { geometry Sphere { radius 5 } }");
  ASSERT_EQ(a.components.size(), 3u);
  const double volumes[] = {kPi * 4 * 10, kPi * 9 * 8 / 3, kPi * 500 / 3};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(a.components[i].faults.bounds_solid());
    EXPECT_NEAR(signed_volume(*a.components[i].mesh), volumes[i], 0.005 * volumes[i]);
  }
  EXPECT_NEAR(assembled_bounds(a.components[0]).upper.y, 5, 1e-9);
  EXPECT_NEAR(assembled_bounds(a.components[1]).lower.y, -4, 1e-9);
  EXPECT_GT(a.deflection, 0);
}

TEST(ReadVrml, ScalesUnevenlyMirrorsAndReversesFaces) {
  const Assembly uneven = read("Transform { center 1 1 1 scale 1 2 -3 children Shape { geometry " + kFaces + " } }");
  ASSERT_EQ(uneven.components.size(), 1u);
  EXPECT_NEAR(signed_volume(*uneven.components[0].mesh), 1000, 1e-9);
  expect_box(assembled_bounds(uneven), {0, -1, -26}, {10, 19, 4});
  std::string clockwise = kFaces;
  clockwise.insert(clockwise.find('{') + 1, " ccw FALSE");
  EXPECT_LT(signed_volume(*read("Shape { geometry " + clockwise + " }").components[0].mesh), 0);
}

TEST(ReadVrml, ShowsTheChosenChildAndTheFirstLevel) {
  const std::string small = "Shape { geometry Box { size 1 1 1 } }", large = "Shape { geometry Box { size 9 9 9 } }";
  expect_box(assembled_bounds(read("Switch { whichChoice 1 choice [ " + small + large + " ] }")), {-4.5, -4.5, -4.5},
             {4.5, 4.5, 4.5});
  expect_box(assembled_bounds(read("LOD { level [ " + small + large + " ] }")), {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  EXPECT_NE(error_of("Switch { choice " + small + " }").find("no component"), std::string::npos);
}

TEST(ReadVrml, JoinsOpenShapesWithoutANameInAGroup) {
  const std::string points = "coord Coordinate { point [ 0 0 0, 10 0 0, 0 10 0, 0 0 10 ] }";
  const auto side = [&](const std::string& corners) {
    return "Shape { geometry IndexedFaceSet { " + points + " coordIndex [ " + corners + " ] } }\n";
  };
  const std::string sides = side("0 2 1") + side("0 1 3 -1 0 3 2") + side("1 2 3");
  const Assembly a =
      read("DEF part Group { children [ " + sides + "Shape { geometry Box { } } DEF own " + side("0 2 1") + " ] }");
  ASSERT_EQ(a.components.size(), 3u);
  EXPECT_EQ(a.components[1].name, "own");
  EXPECT_EQ(a.components[2].name, "part#2");
  EXPECT_TRUE(a.components[2].faults.bounds_solid());
  EXPECT_NEAR(signed_volume(*a.components[2].mesh), 1000.0 / 6, 1e-9);
  EXPECT_EQ(read(sides).components.size(), 1u);
}

TEST(ReadVrml, LeavesOutWhatIsNoSurface) {
  const Assembly a = read(
      "PROTO P [ field SFVec3f at 0 0 0 field MFString s [ \"}]\" ] ] { Transform { translation IS at } }\n"
      "WorldInfo { title \"a } b\" info [ \"x\", \"y\" ] } # a comment {\n"
      "Viewpoint { position 1 2 3 description \"v\" }\nDirectionalLight { on FALSE intensity 0.5 }\n"
      "Shape { geometry IndexedLineSet { coord DEF C Coordinate { point [ 0 0 0, 1 0 0, 0 1 0 ] } coordIndex [ 0 1 ] } "
      "}\n"
      "Shape { geometry IndexedFaceSet { coord USE C normal Normal { vector [ 0 0 1 ] } coordIndex [ 0 1 2 ] } }\n"
      "ROUTE a.b TO c.d");
  ASSERT_EQ(a.components.size(), 1u);
  EXPECT_EQ(a.components[0].mesh->faces.size(), 1u);
}

TEST(ReadVrml, SaysWhatIsWrongWithAFile) {
  const auto expect = [](const std::string& body, const std::string& why) {
    const std::string error = error_of(body);
    EXPECT_NE(error.find(why), std::string::npos) << error;
  };
  expect("Shape { geometry Box { }", "line 2: it ends too early");
  expect("Shape { geometry Box { size nan 1 1 } }", "\"nan\" is no finite number");
  expect("Shape { geometry Sphere { radius 1e999 } }", "\"1e999\" is no finite number");
  expect("Shape { geometry Sphere { radius -1 } }", "a shape of no size");
  expect("USE nothing", "USE of a name without DEF");
  expect("DEF A Group { children [ Shape { geometry Box { } } USE A ] }", "USE of a name without DEF");
  expect("Inline { url \"b.wrl\" }", "a file within the file");
  expect("Shape { geometry Extrusion { } }", "not supported (Extrusion)");
  expect("PROTO P [ ] { Group { } }\nP { }", "line 3: a shape that is not supported (P)");
  expect("Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0 ] } coordIndex [ 0 1 2 ] } }",
         "out of range");
  expect("17 { }", "where a node should begin");
  EXPECT_NE(import_vrml({"#VRML V1.0 ascii\n", "a.wrl"}, {}).error().message.find("VRML 1.0"), std::string::npos);
  EXPECT_NE(import_vrml({"solid cube", "a.wrl"}, {}).error().message.find("does not begin"), std::string::npos);
}

TEST(ReadVrml, RefusesNestingAndScenesThatExplode) {
  std::string deep, closing;
  for (int i = 0; i < 100'000; ++i) deep += "Group { children ";
  EXPECT_NE(error_of(deep).find("nested too deep"), std::string::npos);
  std::string doubling = "DEF g0 Shape { geometry Box { } }\n";
  for (int i = 1; i < 60; ++i) {
    const std::string below = "USE g" + std::to_string(i - 1) + " ";
    doubling += "DEF g" + std::to_string(i) + " Group { children [ " + below + below + "] }\n";
  }
  EXPECT_NE(error_of(doubling).find("more than"), std::string::npos);
  EXPECT_NE(read_text("Shape { geometry " + kFaces + " }", "mm", 3).error().message.find("limit"), std::string::npos);
}

TEST(ReadVrml, ReadsOrRefusesFilesWithChangedBytes) {
  const std::string whole = "DEF a Transform { translation 1 2 3 children [ Shape { geometry " + kFaces +
                            " } Shape { geometry Cone { } } ] }";
  const unsigned seed = 7;
  std::mt19937 random(seed);
  const std::string alphabet = "0123456789{}[]\",.-# DEFUSE";
  int read = 0;
  for (int round = 0; round < 5000; ++round) {
    std::string changed = whole.substr(0, round % 3 ? whole.size() : random() % whole.size());
    for (int k = 0; k < 1 + round % 6 && !changed.empty(); ++k)
      changed[random() % changed.size()] = alphabet[random() % alphabet.size()];
    const Result<Assembly> a = read_text(changed);
    EXPECT_TRUE(a.ok() || a.error().message.find('\n') == std::string::npos);
    read += a.ok() ? 1 : 0;
  }
  std::printf("seed %u: %d of 5000 changed files could still be read\n", seed, read);
}

}  // namespace
}  // namespace dismantle
