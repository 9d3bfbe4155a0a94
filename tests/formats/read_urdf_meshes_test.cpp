// SPDX-License-Identifier: Apache-2.0
// URDF files with meshes in COLLADA, and what is kept of them in the cache.
#include "dismantle/loading/load_assembly.h"
#include "tests/support/parse_expectations.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace dismantle {
namespace {

namespace fs = std::filesystem;

/// A tetrahedron with edges of `size` along the axes.
std::string obj(const std::string& size, const std::string& before = "") {
  return before + "v 0 0 0\nv " + size + " 0 0\nv 0 " + size + " 0\nv 0 0 " + size +
         "\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
}

/// Two tetrahedra as above: a green one with edges of 1, and a red one of 10, moved by 100 along x.
std::string collada(const std::string& unit, const std::string& up_axis) {
  const auto effect = [](const std::string& name, const std::string& color) {
    return "<effect id='" + name + "-fx'><profile_COMMON><technique sid='c'><lambert><diffuse><color>" + color +
           "</color></diffuse></lambert></technique></profile_COMMON></effect>";
  };
  const auto material = [](const std::string& name) {
    return "<material id='" + name + "'><instance_effect url='#" + name + "-fx'/></material>";
  };
  const auto geometry = [](const std::string& color) {
    return "<instance_geometry url='#g'><bind_material><technique_common><instance_material symbol='m' target='#" +
           color + "'/></technique_common></bind_material></instance_geometry>";
  };
  return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'><asset>" +
         unit + up_axis + "</asset><library_effects>" + effect("green", "0 1 0 1") + effect("red", "1 0 0 1") +
         "</library_effects><library_materials>" + material("green") + material("red") +
         "</library_materials><library_geometries><geometry id='g'><mesh><source id='p'>"
         "<float_array id='pa' count='12'>0 0 0 1 0 0 0 1 0 0 0 1</float_array><technique_common>"
         "<accessor source='#pa' count='4' stride='3'><param name='X' type='float'/><param name='Y' type='float'/>"
         "<param name='Z' type='float'/></accessor></technique_common></source>"
         "<vertices id='v'><input semantic='POSITION' source='#p'/></vertices><triangles material='m' count='4'>"
         "<input semantic='VERTEX' source='#v' offset='0'/><p>0 2 1 0 1 3 1 2 3 2 0 3</p></triangles></mesh></geometry>"
         "</library_geometries><library_visual_scenes><visual_scene id='s'><node name='small'>" +
         geometry("green") + "</node><node name='large'><translate>100 0 0</translate><scale>10 10 10</scale>" +
         geometry("red") +
         "</node></visual_scene></library_visual_scenes><scene><instance_visual_scene url='#s'/></scene></COLLADA>";
}

const std::string kMillimetres = "<unit name='millimeter' meter='0.001'/>";

std::string urdf(const std::string& visual) {
  return "<robot name='arm'><link name='base'><visual>" + visual + "</visual></link></robot>";
}

std::string mesh(const std::string& file, const std::string& scale = "1 1 1") {
  return "<geometry><mesh filename='" + file + "' scale='" + scale + "'/></geometry>";
}

void expect_box(const Assembly& assembly, Vec3 lower, Vec3 upper) {
  const Aabb box = assembled_bounds(assembly);
  EXPECT_LT(max_abs(box.lower - lower), 1e-3) << box.lower.x << " " << box.lower.y << " " << box.lower.z;
  EXPECT_LT(max_abs(box.upper - upper), 1e-3) << box.upper.x << " " << box.upper.y << " " << box.upper.z;
}

/// Skips the test if this build reads no COLLADA.
class ReadUrdfMeshes : public ::testing::Test {
 protected:
  void SetUp() override {
    const Result<Assembly> a = load_dae(collada(kMillimetres, ""), urdf(mesh("a.dae")));
    if (!a && a.error().message.find("built without Assimp") != std::string::npos) GTEST_SKIP() << "there is no Assimp";
  }
  Result<Assembly> load_dae(const std::string& dae, const std::string& robot, const ImportOptions& options = {}) const {
    folder_.put("a.dae", dae);
    return load_assembly(folder_.put("arm.urdf", robot), options);
  }
  ScratchFolder folder_;
};

TEST_F(ReadUrdfMeshes, JoinsTheNodesOfACollada) {
  const Result<Assembly> a = load_dae(collada(kMillimetres, ""), urdf(mesh("a.dae")));
  ASSERT_TRUE(a.ok()) << a.error().message;
  ASSERT_EQ(a->components.size(), 1u);
  EXPECT_EQ(a->components[0].name, "base");
  EXPECT_EQ(a->components[0].mesh->faces.size(), 8u);
  EXPECT_EQ(a->components[0].color, (Color{1, 0, 0, 1})) << "that of the largest surface";
  EXPECT_TRUE(a->components[0].faults.bounds_solid());
  EXPECT_EQ(a->source_units, "m");

  const std::string blue = "<material name='blue'><color rgba='0 0 1 1'/></material>";
  EXPECT_EQ(load_dae(collada(kMillimetres, ""), urdf(blue + mesh("a.dae")))->components[0].color, (Color{0, 0, 1, 1}));
}

TEST_F(ReadUrdfMeshes, ScalesAColladaFromItsUnitAndIgnoresItsUpAxis) {
  for (const char* up_axis : {"", "<up_axis>X_UP</up_axis>", "<up_axis>Y_UP</up_axis>", "<up_axis>Z_UP</up_axis>"})
    for (const auto& [unit, factor] : {std::pair(kMillimetres, 1.0),
                                       {"<unit meter='0.0254'/>", 25.4},
                                       {"<unit meter='1'/>", 1000.0},
                                       {"", 1000.0}}) {
      const Result<Assembly> a = load_dae(collada(unit, up_axis), urdf(mesh("a.dae", "1 1 2")));
      ASSERT_TRUE(a.ok()) << a.error().message;
      expect_box(*a, {0, 0, 0}, {110 * factor, 10 * factor, 20 * factor});
    }
  ImportOptions options;
  options.units = "cm";  // of the URDF instead of metres
  const Result<Assembly> a = load_dae(collada(kMillimetres, ""), urdf(mesh("a.dae")), options);
  ASSERT_TRUE(a.ok()) << a.error().message;
  expect_box(*a, {0, 0, 0}, {1.1, 0.1, 0.1});
}

TEST_F(ReadUrdfMeshes, SaysWhatIsWrongWithACollada) {
  const std::string robot = urdf(mesh("a.dae"));
  expect_unreadable(load_dae("no XML", robot), "a.dae cannot be read as COLLADA");
  const std::string whole = collada(kMillimetres, "");
  expect_unreadable(load_dae(whole.substr(0, whole.size() / 2), robot), "a.dae cannot be read as COLLADA");
  std::string out_of_range = whole;
  out_of_range.replace(out_of_range.find("0 2 1 0 1 3"), 11, "0 2 9 0 1 3");
  EXPECT_FALSE(load_dae(out_of_range, robot).ok());
  std::string loop = whole;
  loop.replace(loop.find("<node name='small'>"), 19, "<node id='n' name='small'><instance_node url='#n'/>");
  EXPECT_FALSE(load_dae(loop, robot).ok());
  ImportOptions options;
  options.limits.triangles = 7;
  expect_unreadable(load_dae(whole, robot, options), "triangles");
}

TEST_F(ReadUrdfMeshes, FindsAColladaOfItsPackageAndNoOther) {
  folder_.put("ws/arm/package.xml", "<package/>");
  folder_.put("ws/arm/meshes/UPPER.DAE", collada(kMillimetres, ""));
  folder_.put("ws/secret/a.dae", collada(kMillimetres, ""));
  const auto load = [&](const std::string& address) {
    return load_assembly(folder_.put("ws/arm/urdf/arm.urdf", urdf(mesh(address))));
  };
  EXPECT_TRUE(load("package://arm/meshes/UPPER.DAE").ok());
  EXPECT_TRUE(load("../meshes/UPPER.DAE").ok());
  expect_unreadable(load("../../secret/a.dae"), "which is not in its folder");
  fs::create_symlink(folder_ / "ws/secret/a.dae", folder_ / "ws/arm/meshes/link.dae");
  expect_unreadable(load("../meshes/link.dae"), "symbolic link");
}

/// Keeps what was read in a cache.
class UrdfCache : public ::testing::Test {
 protected:
  UrdfCache() { options_.cache_folder = folder_ / "cache"; }
  double size_of(const std::string& file) const {
    const Result<Assembly> a = load_assembly(folder_ / file, options_);
    EXPECT_TRUE(a.ok()) << message_of(a);
    return a ? assembled_bounds(*a).size().x : 0;
  }
  auto kept() const { return std::distance(fs::directory_iterator(options_.cache_folder), fs::directory_iterator()); }
  ScratchFolder folder_;
  ImportOptions options_;
};

TEST_F(UrdfCache, ReadsAChangedMeshAnew) {
  folder_.put("arm/a.obj", obj("1"));
  folder_.put("arm/arm.urdf", urdf(mesh("a.obj")));
  EXPECT_NEAR(size_of("arm/arm.urdf"), 1000, 1e-6);
  EXPECT_NEAR(size_of("arm/arm.urdf"), 1000, 1e-6);
  EXPECT_EQ(kept(), 1);
  folder_.put("arm/a.obj", obj("2"));
  EXPECT_NEAR(size_of("arm/arm.urdf"), 2000, 1e-6);
  fs::remove(folder_ / "arm/a.obj");
  expect_unreadable(load_assembly(folder_ / "arm/arm.urdf", options_), "which is not there");
}

TEST_F(UrdfCache, SeesMaterialsAndMeshesThatAppear) {
  folder_.put("ws/arm/package.xml", "<package/>");
  folder_.put("ws/arm/a.obj", obj("1", "mtllib a.mtl\nusemtl paint\n"));
  folder_.put("ws/arm/urdf/arm.urdf", urdf(mesh("package://arm/a.obj")));
  EXPECT_NEAR(size_of("ws/arm/urdf/arm.urdf"), 1000, 1e-6);
  folder_.put("ws/arm/a.mtl", "newmtl paint\nKd 0 1 0\n");
  const Result<Assembly> painted = load_assembly(folder_ / "ws/arm/urdf/arm.urdf", options_);
  ASSERT_TRUE(painted.ok()) << painted.error().message;
  EXPECT_EQ(painted->components[0].color, (Color{0, 1, 0, 1}));
  folder_.put("ws/arm/urdf/arm/a.obj", obj("3"));  // a place that is looked at before
  EXPECT_NEAR(size_of("ws/arm/urdf/arm.urdf"), 3000, 1e-6);
}

TEST_F(UrdfCache, KeepsEqualFilesInOtherFoldersApart) {
  folder_.put("package.xml", "<package/>");
  for (const std::string version : {"1", "2"}) {
    folder_.put(version + "/a.obj", obj(version));
    folder_.put(version + "/arm.urdf", urdf(mesh("a.obj")));
  }
  EXPECT_NEAR(size_of("1/arm.urdf"), 1000, 1e-6);
  EXPECT_NEAR(size_of("2/arm.urdf"), 2000, 1e-6);
}

TEST_F(UrdfCache, KeepsJoinedVisualsApart) {
  const std::string visual = "<visual><geometry><box size='1 1 1'/></geometry></visual>";
  folder_.put("arm.urdf", "<robot name='arm'><link name='base'>" + visual + visual + "</link></robot>");
  EXPECT_EQ(load_assembly(folder_ / "arm.urdf", options_)->components.size(), 2u);
  options_.solids = Solids::Join;
  EXPECT_EQ(load_assembly(folder_ / "arm.urdf", options_)->components.size(), 1u);
}

}  // namespace
}  // namespace dismantle
