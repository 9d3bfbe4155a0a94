// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/threemf/read_3mf.h"

#include "tests/formats/threemf_files.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

const std::string kTetrahedron = "<object id='1' name='t\xc3\xa4t'>" + kTetrahedronMesh + "</object>";

Result<Assembly> read_model(const ScratchFolder& folder, const std::string& model, const ImportOptions& options = {}) {
  write_3mf(folder / "a.3mf", model);
  return read_3mf(folder / "a.3mf", options);
}

std::string error_of(const std::string& model, const ImportOptions& options = {}) {
  const ScratchFolder folder;
  const Result<Assembly> a = read_model(folder, model, options);
  return a ? std::string() : a.error().message;
}

void expect_box(const Aabb& box, Vec3 lower, Vec3 upper) {
  EXPECT_LT(max_abs(box.lower - lower), 1e-9) << box.lower.x << " " << box.lower.y << " " << box.lower.z;
  EXPECT_LT(max_abs(box.upper - upper), 1e-9) << box.upper.x << " " << box.upper.y << " " << box.upper.z;
}

TEST(Read3mf, MakesAComponentOfEachOccurrenceOfAMesh) {
  const ScratchFolder folder;
  const Result<Assembly> a = read_model(
      folder,
      threemf_model(kTetrahedron +
                        "<object id='2' name='pair'><components><component objectid='1'/>"
                        "<component objectid='1' transform='0 1 0 -1 0 0 0 0 1 100 0 0'/></components></object>",
                    "<item objectid='2' transform='1 0 0 0 1 0 0 0 1 0 0 5'/><item objectid='1'/>"));
  ASSERT_TRUE(a.ok()) << a.error().message;
  ASSERT_EQ(a->components.size(), 3u);
  EXPECT_EQ(a->components[0].name, "t\xc3\xa4t");
  EXPECT_EQ(a->tree[a->tree[a->components[1].tree_node].parent].name, "pair");
  EXPECT_EQ(a->components[0].mesh, a->components[1].mesh);
  EXPECT_EQ(a->source_units, "mm");
  EXPECT_EQ(a->source_sha256.size(), 64u);
  expect_box(assembled_bounds(a->components[0]), {0, 0, 5}, {10, 10, 15});
  expect_box(assembled_bounds(a->components[1]), {90, 0, 5}, {100, 10, 15});  // x to y, y to -x
  expect_box(assembled_bounds(a->components[2]), {0, 0, 0}, {10, 10, 10});
  for (const Component& c : a->components) EXPECT_NEAR(signed_volume(*c.mesh), 1000.0 / 6, 1e-9);
}

TEST(Read3mf, ScalesToMillimetresByTheFilesUnitOrTheUsers) {
  for (const auto& [unit, ours, factor] : {std::tuple("micron", "um", 0.001),
                                           {"centimeter", "cm", 10.0},
                                           {"inch", "in", 25.4},
                                           {"foot", "ft", 304.8},
                                           {"meter", "m", 1000.0}}) {
    const ScratchFolder folder;
    const std::string model = threemf_model(kTetrahedron, "<item objectid='1'/>", unit);
    const Result<Assembly> a = read_model(folder, model);
    ASSERT_TRUE(a.ok()) << a.error().message;
    EXPECT_EQ(a->source_units, ours);
    EXPECT_NEAR(assembled_bounds(*a).upper.x, 10 * factor, 1e-9);
    ImportOptions options;
    options.units = "cm";
    EXPECT_NEAR(assembled_bounds(*read_model(folder, model, options)).upper.x, 100, 1e-9);
  }
}

TEST(Read3mf, TurnsMirroredObjectsRightSideOut) {
  const ScratchFolder folder;
  const Result<Assembly> a =
      read_model(folder, threemf_model(kTetrahedron, "<item objectid='1' transform='-2 0 0 0 1 0 0 0 1 0 0 0'/>"));
  ASSERT_TRUE(a.ok()) << a.error().message;
  EXPECT_NEAR(signed_volume(*a->components[0].mesh), 2000.0 / 6, 1e-9);
  EXPECT_FALSE(a->components[0].faults.inside_out);
  expect_box(assembled_bounds(*a), {-20, 0, 0}, {0, 10, 10});
}

TEST(Read3mf, FindsObjectsInOtherModelParts) {
  const ScratchFolder folder;
  write_3mf(folder / "a.3mf",
            threemf_model("<object id='7'><components><component p:path='/3D/parts/t.model' objectid='1'/></components>"
                          "</object>",
                          "<item objectid='7'/>"),
            {{"3D/parts/t.model", threemf_model(kTetrahedron, "")}});
  const Result<Assembly> a = read_3mf(folder / "a.3mf", {});
  ASSERT_TRUE(a.ok()) << a.error().message;
  ASSERT_EQ(a->components.size(), 1u);
}

TEST(Read3mf, TakesColoursOfMaterialsAndOfTheLargestArea) {
  const ScratchFolder folder;
  std::string painted = kTetrahedronMesh;
  painted.replace(painted.find("v1='1' v2='2' v3='3'"), 20, "v1='1' v2='2' v3='3' pid='6' p1='1'");
  const Result<Assembly> a = read_model(
      folder, threemf_model("<basematerials id='5'><base name='x' displaycolor='#FF0000'/></basematerials>"
                            "<m:colorgroup id='6'><m:color color='#000000'/><m:color color='#0000FF80'/></m:colorgroup>"
                            "<object id='1' pid='5' pindex='0'>" +
                                kTetrahedronMesh + "</object><object id='2' pid='5' pindex='0'>" + painted +
                                "</object><object id='3' type='support'>" + kTetrahedronMesh + "</object>",
                            "<item objectid='1'/><item objectid='2'/><item objectid='3'/>"));
  ASSERT_TRUE(a.ok()) << a.error().message;
  ASSERT_EQ(a->components.size(), 2u);
  EXPECT_EQ(a->components[0].color, (Color{1, 0, 0, 1}));
  EXPECT_EQ(a->components[1].color.r, 1);  // 150 of 236 square millimetres
}

TEST(Read3mf, SaysWhatIsWrongWithAFile) {
  const auto expect = [](const std::string& model, const std::string& why) {
    const std::string error = error_of(model);
    EXPECT_NE(error.find(why), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos);
  };
  const std::string item = "<item objectid='1'/>";
  expect("<model><build>", "no well-formed XML");
  expect("<html/>", "its root is no <model>");
  expect(threemf_model(kTetrahedron, item, "furlong"), "unknown unit \"furlong\"");
  expect(threemf_model(kTetrahedron, "<item objectid='9'/>"), "object 9 is not there");
  expect(threemf_model(kTetrahedron, "<item objectid='1' transform='1 0 0'/>"), "not twelve finite numbers");
  expect(threemf_model(kTetrahedron, "<item objectid='1' transform='nan 0 0 0 1 0 0 0 1 0 0 0'/>"), "not twelve");
  expect(threemf_model(kTetrahedron + kTetrahedron, item), "a second object 1");
  expect(threemf_model("", ""), "holds no component");
  std::string mesh = kTetrahedron;
  mesh.replace(mesh.find("x='10'"), 6, "x='1e999'");
  expect(threemf_model(mesh, item), "a vertex without three finite numbers");
  mesh = kTetrahedron;
  mesh.replace(mesh.find("v3='3'"), 6, "v3='4'");
  expect(threemf_model(mesh, item), "a triangle of vertices that are not there");
  expect(threemf_model(
             "<object id='1'><components><component p:path='/3D/no.model' objectid='1'/></components></object>", item),
         "\"3D/no.model\" is missing");

  const ScratchFolder folder;
  EXPECT_NE(read_3mf(folder.put("b.3mf", "no archive"), {}).error().message.find("no zip archive"), std::string::npos);
  write_zip(folder / "c.3mf", {{"other", "x"}});
  EXPECT_NE(read_3mf(folder / "c.3mf", {}).error().message.find("is missing"), std::string::npos);
}

TEST(Read3mf, RefusesObjectsThatHoldThemselvesOrExplode) {
  const std::string loop =
      "<object id='1'><components><component objectid='2'/></components></object>"
      "<object id='2'><components><component objectid='1'/></components></object>";
  ImportOptions options;
  options.limits.components = 1000;
  EXPECT_NE(error_of(threemf_model(loop, "<item objectid='1'/>"), options).find("endless nesting"), std::string::npos);
  std::string doubling = kTetrahedron;
  for (int i = 2; i < 60; ++i) {
    const std::string below = "<component objectid='" + std::to_string(i - 1) + "'/>";
    doubling += "<object id='" + std::to_string(i) + "'><components>" + below + below + "</components></object>";
  }
  EXPECT_NE(error_of(threemf_model(doubling, "<item objectid='59'/>"), options).find("more than"), std::string::npos);
}

TEST(Read3mf, IgnoresEntitiesAndRefusesDeepXml) {
  const std::string entities =
      "<?xml version='1.0'?><!DOCTYPE model [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;&a;&a;&a;&a;&a;'>]>"
      "<model><resources><object id='1' name='&b;'>" +
      kTetrahedronMesh + "</object></resources><build><item objectid='1'/></build></model>";
  const ScratchFolder folder;
  const Result<Assembly> a = read_model(folder, entities);
  ASSERT_TRUE(a.ok()) << a.error().message;
  EXPECT_LT(a->components[0].name.size(), 10u);
  std::string deep = "<model>";
  for (int i = 0; i < 100'000; ++i) deep += "<a>";
  EXPECT_NE(error_of(deep).find("no well-formed XML"), std::string::npos);
}

TEST(Read3mf, StopsAtTheLimits) {
  ImportOptions options;
  options.limits.triangles = 3;
  EXPECT_NE(error_of(threemf_model(kTetrahedron, "<item objectid='1'/>"), options).find("limit"), std::string::npos);
  options.limits.triangles = 6;
  EXPECT_NE(
      error_of(threemf_model(kTetrahedron, "<item objectid='1'/><item objectid='1'/>"), options).find("too large"),
      std::string::npos);
}

}  // namespace
}  // namespace dismantle
