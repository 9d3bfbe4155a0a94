// SPDX-License-Identifier: Apache-2.0
#include "dismantle/loading/load_assembly.h"

#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <random>

namespace dismantle {
namespace {

/// A document whose geometry "g" is a tetrahedron with edges of 10 along the axes, half of it as triangles and half as
/// a list of polygons; the material of one is red.
std::string collada(const std::string& scene, const std::string& nodes = "", const std::string& unit = "0.001") {
  return R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="u" meter=")" +
         unit + R"("/><up_axis>Z_UP</up_axis></asset>
<library_effects><effect id="fx"><profile_COMMON><technique sid="c"><lambert><diffuse><color>1 0 0 1</color></diffuse>
</lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="red" name="red"><instance_effect url="#fx"/></material></library_materials>
<library_geometries><geometry id="g" name="tet"><mesh><source id="p">
<float_array id="pa" count="12">0 0 0 10 0 0 0 10 0 0 0 10</float_array>
<technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles material="m" count="2"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3</p></triangles>
<polylist material="n" count="2"><input semantic="VERTEX" source="#v" offset="0"/><vcount>3 3</vcount>
<p>0 3 2 1 2 3</p></polylist></mesh></geometry></library_geometries>
<library_nodes>)" +
         nodes + R"(</library_nodes><library_visual_scenes><visual_scene id="s" name="s">)" + scene +
         R"(</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>
)";
}

const std::string kTetrahedron =
    "<instance_geometry url='#g'><bind_material><technique_common><instance_material symbol='m' target='#red'/>"
    "<instance_material symbol='n' target='#red'/></technique_common></bind_material></instance_geometry>";

/// Skips the test if this build reads no COLLADA.
class ReadCollada : public ::testing::Test {
 protected:
  void SetUp() override {
    const Result<Assembly> a = read_text(collada("<node>" + kTetrahedron + "</node>"));
    if (!a && a.error().message.find("built without Assimp") != std::string::npos) GTEST_SKIP() << "there is no Assimp";
  }
  Result<Assembly> read_text(const std::string& text, const ImportOptions& options = {}) const {
    return load_assembly(folder_.put("a.dae", text), options);
  }
  std::string error_of(const std::string& text) const {
    const Result<Assembly> a = read_text(text);
    return a ? std::string() : a.error().message;
  }
  ScratchFolder folder_;
};

void expect_box(const Aabb& box, Vec3 lower, Vec3 upper) {
  EXPECT_LT(max_abs(box.lower - lower), 1e-4) << box.lower.x << " " << box.lower.y << " " << box.lower.z;
  EXPECT_LT(max_abs(box.upper - upper), 1e-4) << box.upper.x << " " << box.upper.y << " " << box.upper.z;
}

TEST_F(ReadCollada, MakesAComponentOfEachNodeWithAMesh) {
  const Result<Assembly> a = read_text(collada(
      "<node name='one'><translate>0 0 50</translate><rotate>0 0 1 90</rotate><instance_node url='#pair'/></node>"
      "<node name='three'><scale>1 2 1</scale>" +
          kTetrahedron + "</node>",
      "<node id='pair' name='pair'><node id='a' name='t\xc3\xa4t'>" + kTetrahedron +
          "</node><node id='b' name='mirrored'><matrix>-1 0 0 100 0 1 0 0 0 0 1 0 0 0 0 1</matrix>" + kTetrahedron +
          "</node></node>"));
  ASSERT_TRUE(a.ok()) << a.error().message;
  ASSERT_EQ(a->components.size(), 3u);
  EXPECT_EQ(a->components[0].name, "t\xc3\xa4t");
  EXPECT_EQ(a->tree[a->tree[a->components[1].tree_node].parent].name, "pair");
  EXPECT_EQ(a->source_units, "mm");
  EXPECT_EQ(a->source_file, "a.dae");
  expect_box(assembled_bounds(a->components[0]), {-10, 0, 50}, {0, 10, 60});
  expect_box(assembled_bounds(a->components[1]), {-10, 90, 50}, {0, 100, 60});
  expect_box(assembled_bounds(a->components[2]), {0, 0, 0}, {10, 20, 10});
  for (const Component& c : a->components) {
    EXPECT_TRUE(c.faults.bounds_solid()) << c.name;
    EXPECT_EQ(c.color, (Color{1, 0, 0, 1})) << c.name;
  }
  EXPECT_NEAR(signed_volume(*a->components[1].mesh), 1000.0 / 6, 1e-3);
  EXPECT_NEAR(signed_volume(*a->components[2].mesh), 2000.0 / 6, 1e-3);
}

TEST_F(ReadCollada, ScalesToMillimetresAndKeepsTheAxes) {
  const std::string node = "<node>" + kTetrahedron + "</node>";
  for (const auto& [unit, name, factor] :
       {std::tuple("0.0254", "in", 25.4), {"0.01", "cm", 10.0}, {"1", "m", 1000.0}, {"0.05", "50.000000 mm", 50.0}}) {
    const Result<Assembly> a = read_text(collada(node, "", unit));
    ASSERT_TRUE(a.ok()) << a.error().message;
    EXPECT_EQ(a->source_units, name);
    EXPECT_NEAR(assembled_bounds(*a).upper.z, 10 * factor, 1e-6 * factor);
    ImportOptions options;
    options.units = "cm";
    EXPECT_NEAR(assembled_bounds(*read_text(collada(node, "", unit), options)).upper.z, 100, 1e-4);
  }
  ImportOptions options;
  options.units = "furlong";
  EXPECT_EQ(read_text(collada(node), options).error().kind, ErrorKind::Usage);
}

TEST_F(ReadCollada, SaysWhatIsWrongWithAFile) {
  const std::string whole = collada("<node>" + kTetrahedron + "</node>");
  EXPECT_NE(error_of("no XML").find("cannot be read as COLLADA"), std::string::npos);
  EXPECT_NE(error_of(whole.substr(0, whole.size() / 2)), "");
  EXPECT_NE(error_of(collada("")), "");
  EXPECT_NE(error_of(collada("<node><instance_geometry url='#none'/></node>")), "");
  std::string out_of_range = whole;
  out_of_range.replace(out_of_range.find("0 2 1 0 1 3"), 11, "0 2 9 0 1 3");
  EXPECT_NE(error_of(out_of_range), "");
  std::string huge = whole;
  huge.replace(huge.find("count=\"12\""), 10, "count=\"4000000000\"");
  error_of(huge);
  std::string not_a_number = whole;
  not_a_number.replace(not_a_number.find("10 0 0 0 10"), 11, "nan 0 0 0 9");
  error_of(not_a_number);
}

TEST_F(ReadCollada, SurvivesLoopsAndNodesThatExplode) {
  EXPECT_NE(error_of(collada("<node><instance_node url='#a'/></node>",
                             "<node id='a'><node><instance_node url='#a'/></node></node>")),
            "");
  std::string doubling = "<node id='n0'>" + kTetrahedron + "</node>";
  for (int i = 1; i < 40; ++i) {
    const std::string below = "<instance_node url='#n" + std::to_string(i - 1) + "'/>";
    doubling += "<node id='n" + std::to_string(i) + "'>" + below + below + "</node>";
  }
  EXPECT_NE(error_of(collada("<node><instance_node url='#n39'/></node>", doubling)), "");
  std::string entities = collada("<node name='&b;'>" + kTetrahedron + "</node>");
  entities.insert(entities.find("<COLLADA"), "<!DOCTYPE a [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;&a;'>]>");
  error_of(entities);
}

TEST_F(ReadCollada, ReadsOrRefusesFilesWithChangedBytes) {
  const std::string whole = collada("<node name='a'><translate>1 2 3</translate>" + kTetrahedron + "</node>");
  const unsigned seed = 3;
  std::mt19937 random(seed);
  int read = 0;
  for (int round = 0; round < 60; ++round) {
    std::string changed = whole;
    for (int k = 0; k < 1 + round % 5; ++k) changed[random() % changed.size()] = "0123456789<>/\"'#- "[random() % 18];
    const Result<Assembly> a = read_text(changed);
    EXPECT_TRUE(a.ok() || a.error().message.find('\n') == std::string::npos);
    read += a.ok() ? 1 : 0;
  }
  std::printf("seed %u: %d of 60 changed files could still be read\n", seed, read);
}

}  // namespace
}  // namespace dismantle
