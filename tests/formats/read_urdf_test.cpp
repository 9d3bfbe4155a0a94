// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/urdf/read_urdf.h"

#include "dismantle/formats/mesh/tessellate.h"
#include "dismantle/formats/urdf/urdf_kinematics.h"
#include "dismantle/loading/load_assembly.h"
#include "tests/support/parse_expectations.h"
#include "tests/support/scratch_folder.h"

#include <cmath>
#include <numbers>

namespace dismantle {

namespace {

constexpr const char* kTetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

std::string robot(const std::string& inside) {
  return "<?xml version=\"1.0\"?><robot name=\"arm\">" + inside + "</robot>";
}

std::string link(const std::string& name, const std::string& geometry, const std::string& more = "") {
  return "<link name=\"" + name + "\"><visual>" + more + "<geometry>" + geometry + "</geometry></visual></link>";
}

std::string joint(const std::string& parent, const std::string& child, const std::string& origin = "") {
  return "<joint name=\"" + parent + "-" + child + "\" type=\"revolute\">" + origin + "<parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/><axis xyz=\"0 0 1\"/></joint>";
}

const std::string kBox = "<box size=\"1 2 3\"/>";

Result<Assembly> parse(const std::string& text, const ImportOptions& options = {}) {
  return parse_urdf({text, "arm.urdf"}, options, [](const std::string&) -> Result<std::vector<MeshPart>> {
    return std::vector<MeshPart>{{"small", tessellate_box({0.1, 0.1, 0.1}).mesh, {0, 0, 1, 1}, ""},
                                 {"large", tessellate_box({1, 1, 1}).mesh, {1, 0, 0, 1}, ""}};
  });
}

void expect_near(const Aabb& box, Vec3 lower, Vec3 upper) {
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(box.lower[axis], lower[axis], 1e-9);
    EXPECT_NEAR(box.upper[axis], upper[axis], 1e-9);
  }
}

}  // namespace

TEST(ReadUrdf, PlacesLinksAtZeroJointPositions) {
  const auto assembly = parse(robot(link("tool", kBox, "<origin xyz=\"0 0 1\"/>") + link("base", kBox) +
                                    joint("elbow", "tool", "<origin xyz=\"10 0 0\" rpy=\"0 0 1.5707963267948966\"/>") +
                                    joint("base", "elbow", "<origin rpy=\"0 0 1.5707963267948966\" xyz=\"0 0 5\"/>") +
                                    "<link name=\"elbow\"/>"));
  ASSERT_TRUE(assembly.ok()) << message_of(assembly);
  ASSERT_EQ(assembly->components.size(), 2u) << "a link without visuals is no component";
  EXPECT_EQ(assembly->components[0].name, "tool");
  EXPECT_EQ(assembly->source_units, "m");
  expect_near(assembled_bounds(assembly->components[1]), {-500, -1000, -1500}, {500, 1000, 1500});
  // base -> elbow: up 5 and a quarter turn; elbow -> tool: 10 along the turned x, another quarter turn; up 1.
  expect_near(assembled_bounds(assembly->components[0]), {-500, 9000, 4500}, {500, 11000, 7500});
}

TEST(ReadUrdf, TurnsAboutFixedAxesInOrder) {
  const double quarter = std::numbers::pi / 2;
  const Vec3 x = rotation_from_rpy({quarter, quarter, 0}) * Vec3{0, 1, 0};  // y -> z (roll) -> x (pitch)
  EXPECT_NEAR(length(x - Vec3{1, 0, 0}), 0, 1e-15);
  const Vec3 y = rotation_from_rpy({0, quarter, quarter}) * Vec3{0, 0, 1};  // z -> x (pitch) -> y (yaw)
  EXPECT_NEAR(length(y - Vec3{0, 1, 0}), 0, 1e-15);
}

const std::string kSeveralVisuals =
    robot("<material name=\"grey\"><color rgba=\"0.5 0.5 0.5 1\"/></material>" + link("tool", kBox) +
          "<link name=\"base\">"
          "<visual><material name=\"grey\"/><geometry><mesh filename=\"package://arm/meshes/servo.v1.obj\" "
          "scale=\"0.001 0.001 -0.001\"/></geometry></visual>"
          "<visual name=\"plate\"><material name=\"black\"><color rgba=\"0.1 0.1 0.1 1\"/></material>"
          "<origin xyz=\"3 0 0\" rpy=\"0 0 1.5707963267948966\"/><geometry><box size=\"1 2 1\"/></geometry></visual>"
          "<visual name=\"\"><geometry><sphere radius=\"0.1\"/></geometry></visual>"
          "<visual><geometry><mesh filename=\"../servo.v1.stl\"/></geometry></visual>"
          "<collision><geometry><box size=\"9 9 9\"/></geometry></collision></link>" +
          joint("base", "tool", "<origin xyz=\"0 0 10\"/>"));

TEST(ReadUrdf, MakesAComponentOfEachVisualInAGroupOfTheLink) {
  const auto assembly = parse(kSeveralVisuals);
  ASSERT_TRUE(assembly.ok()) << message_of(assembly);
  std::vector<std::string> names, parents;
  for (const Component& c : assembly->components) {
    names.push_back(c.name);
    parents.push_back(assembly->tree[assembly->tree[c.tree_node].parent].name);
    EXPECT_EQ(assembly->tree[c.tree_node].name, c.name);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"tool", "servo.v1", "plate", "base", "servo.v1#2"}));
  EXPECT_EQ(parents, (std::vector<std::string>{"arm.urdf", "base", "base", "base", "base"}));
  EXPECT_EQ(assembly->tree.size(), 7u) << "the file, its group, and a leaf each";
  EXPECT_EQ(assembly->components[1].color, (Color{0.5f, 0.5f, 0.5f, 1}));
  EXPECT_EQ(assembly->components[2].color, (Color{0.1f, 0.1f, 0.1f, 1}));
  EXPECT_EQ(assembly->components[3].color, Color{});
  EXPECT_EQ(assembly->components[4].color, (Color{1, 0, 0, 1})) << "that of the mesh";
  EXPECT_TRUE(assembly->components[1].faults.closed());
  EXPECT_FALSE(assembly->components[1].faults.inside_out) << "a mirrored mesh is reoriented";
  expect_near(assembled_bounds(assembly->components[1]), {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  expect_near(assembled_bounds(assembly->components[2]), {2000, -500, -500}, {4000, 500, 500});
}

TEST(ReadUrdf, JoinsTheVisualsOfALinkWhenAsked) {
  ImportOptions options;
  options.solids = Solids::Join;
  const auto assembly = parse(kSeveralVisuals, options);
  ASSERT_TRUE(assembly.ok()) << message_of(assembly);
  ASSERT_EQ(assembly->components.size(), 2u);
  const Component& base = assembly->components[1];
  EXPECT_EQ(base.name, "base");
  EXPECT_EQ(assembly->tree[base.tree_node].parent, 0u);
  EXPECT_EQ(base.color, (Color{0.1f, 0.1f, 0.1f, 1})) << "that of the largest";
  EXPECT_TRUE(base.faults.closed());
  EXPECT_FALSE(base.faults.inside_out);
  expect_near(assembled_bounds(base), {-500, -500, -500}, {4000, 500, 500});
}

TEST(ReadUrdf, GroupsOnlyLinksWithComponentsOfSeveralVisuals) {
  const std::string visual = "<visual><geometry>" + kBox + "</geometry></visual>";
  const auto assembly = parse(robot("<link name=\"a\">" + visual + visual + "</link><link name=\"none\"/>" +
                                    link("b", kBox) + "<link name=\"c\">" + visual + visual + "</link>"));
  ASSERT_TRUE(assembly.ok()) << message_of(assembly);
  std::vector<std::string> names;
  for (const TreeNode& node : assembly->tree) names.push_back(node.name);
  EXPECT_EQ(names, (std::vector<std::string>{"arm.urdf", "a", "a", "a#2", "b", "c", "c", "c#2"}));
  EXPECT_EQ(assembly->tree[4].parent, 0u);
  EXPECT_EQ(assembly->tree[7].parent, 5u);
}

TEST(ReadUrdf, TessellatesCylindersAndSpheres) {
  const auto assembly = parse(robot(link("a", "<cylinder radius=\"0.1\" length=\"0.4\"/>") +
                                    link("b", "<sphere radius=\"0.2\"/>", "<origin xyz=\"1 0 0\"/>")));
  ASSERT_TRUE(assembly.ok()) << message_of(assembly);
  const Component& cylinder = assembly->components[0];
  const Component& sphere = assembly->components[1];
  for (const Component* c : {&cylinder, &sphere}) {
    EXPECT_TRUE(c->faults.closed());
    EXPECT_FALSE(c->faults.inside_out);
    EXPECT_EQ(c->faults.degenerate_faces, 0u);
  }
  EXPECT_NEAR(signed_volume(*cylinder.mesh), std::numbers::pi * 100 * 100 * 400, 2e4 * 1.1);
  EXPECT_NEAR(signed_volume(*sphere.mesh) / (4.0 / 3 * std::numbers::pi * 8e6), 1, 0.005);
  const TriangleMesh placed = assembled_mesh(sphere);
  for (const Vec3& p : placed.vertices) EXPECT_NEAR(length(p - Vec3{1000, 0, 0}), 200, 1e-9);

  double deepest = 0;  // triangle centres below the sphere
  for (std::size_t f = 0; f < placed.faces.size(); ++f) {
    const Triangle t = placed.triangle(f);
    deepest = std::max(deepest, 200 - length((t[0] + t[1] + t[2]) / 3.0 - Vec3{1000, 0, 0}));
  }
  EXPECT_LE(deepest, assembly->deflection);
  EXPECT_LT(assembly->deflection, 3 * deepest + 1);
}

TEST(ReadUrdf, FindsMeshesNearTheFile) {
  const ScratchFolder folder;
  folder.put("ws/my_robot/meshes/a.obj", kTetrahedron);
  folder.put("ws/other/b.obj", kTetrahedron);
  const auto file =
      folder.put("ws/my_robot/urdf/arm.urdf",
                 robot(link("one", "<mesh filename=\"../meshes/a.obj\"/>") +
                       link("two", "<mesh filename=\"package://my_robot/meshes/a.obj\"/>") +
                       link("three", "<mesh filename=\"package://other/b.obj\"/>") +
                       link("four", "<mesh filename=\"file://" + (folder / "ws/other/b.obj").string() + "\"/>") +
                       link("five", "<mesh filename=\"package://renamed/meshes/a.obj\" scale=\"2 2 2\"/>")));
  expect_unreadable(load_assembly(file), "which is not in its folder");  // "../meshes"
  folder.put("ws/my_robot/package.xml", "<package/>");
  expect_unreadable(load_assembly(file), "\"package://other/b.obj\", which is not");
  ImportOptions options;
  options.reference_folders = {folder / "ws"};
  const auto assembly = load_assembly(file, options);
  ASSERT_TRUE(assembly.ok()) << message_of(assembly);
  ASSERT_EQ(assembly->components.size(), 5u);
  expect_near(assembled_bounds(assembly->components[0]), {0, 0, 0}, {1000, 1000, 1000});
  expect_near(assembled_bounds(assembly->components[4]), {0, 0, 0}, {2000, 2000, 2000});
  EXPECT_EQ(assembly->source_file, "arm.urdf");

  options.units = "mm";
  const auto small = load_assembly(file, options);
  ASSERT_TRUE(small.ok());
  expect_near(assembled_bounds(small->components[0]), {0, 0, 0}, {1, 1, 1});
}

TEST(ReadUrdf, SaysWhatIsWrongWithAMesh) {
  const ScratchFolder folder;
  folder.put("a.gltf", "{}");
  folder.put("b.obj", "v 1\n");
  const auto load = [&](const std::string& mesh) {
    return load_assembly(folder.put("arm.urdf", robot(link("one", "<mesh filename=\"" + mesh + "\"/>"))));
  };
  expect_unreadable(load("a.gltf"), "mesh \"a.gltf\" is no COLLADA, OBJ, STL or PLY file");
  expect_unreadable(load("none.obj"), "it refers to \"none.obj\", which is not there");
  expect_unreadable(load("package://none/none.obj"), "is not there");
  expect_unreadable(load(""), "it refers to \"\"");
  expect_unreadable(load("b.obj"), "b.obj cannot be read as OBJ");
  expect_unreadable(load("none.dae"), "it refers to \"none.dae\", which is not there");
  expect_unreadable(load("arm.urdf"), "is no COLLADA, OBJ, STL or PLY file");
}

TEST(ReadUrdf, SaysWhatIsWrongAndWhere) {
  expect_unreadable(parse("<robot>"), "no well-formed XML");
  expect_unreadable(parse(""), "no well-formed XML");
  expect_unreadable(parse("<sdf/>"), "its root is no <robot>");
  expect_unreadable(parse(robot("")), "holds no component");
  expect_unreadable(parse(robot(link("a", ""))), "a visual without geometry");
  expect_unreadable(parse(robot(link("a", "<box size=\"1 2\"/>"))), "\"box\" is no mesh, box");
  expect_unreadable(parse(robot(link("a", "<sphere radius=\"-1\"/>"))), "of positive size");
  expect_unreadable(parse(robot(link("a", "<cone radius=\"1\"/>"))), "\"cone\"");
  expect_unreadable(parse(robot(link("a", kBox, "<origin xyz=\"0 0 nan\"/>"))), "xyz \"0 0 nan\" is not three finite");
  expect_unreadable(parse(robot(link("a", kBox, "<origin rpy=\"0 0 0 0\"/>"))), "rpy");
  expect_unreadable(parse(robot(link("a", kBox) + "<joint name=\"j\"/>")), "joint \"j\" lacks its parent or child");
  expect_unreadable(parse(robot(link("a", kBox) + joint("a", "b"))), "names a link that is not there");
  expect_unreadable(
      parse(robot(link("a", kBox) + link("b", kBox) + link("c", kBox) + joint("a", "c") + joint("b", "c"))),
      "link \"c\" has two parents");
  expect_unreadable(parse(robot(link("a", kBox) + link("b", kBox) + joint("a", "b") + joint("b", "a"))),
                    "hangs in a loop");
  expect_unreadable(parse(robot(link("a", kBox) + joint("a", "a"))), "hangs in a loop");
  ImportOptions options;
  options.limits.triangles = 20;
  expect_unreadable(parse(robot(link("a", kBox) + link("b", kBox)), options), "more than 20 triangles");
}

TEST(ReadUrdf, RefusesCoordinatesOutOfRange) {
  const std::string far = "<origin xyz=\"1e308 1e308 1e308\" rpy=\"1 1 1\"/>";
  const std::string back = "<origin xyz=\"-1e308 -1e308 -1e308\" rpy=\"2 3 1\"/>";
  expect_unreadable(parse(robot(link("a", kBox) + link("b", kBox) + link("c", kBox) + link("d", kBox) +
                                joint("a", "b", far) + joint("b", "c", far) + joint("c", "d", back))),
                    "is further out than a thousand kilometres");
  expect_unreadable(parse(robot(link("a", "<box size=\"1e300 1 1\"/>"))), "further out");
}

TEST(ReadUrdf, SurvivesDeepNesting) {
  std::string text;
  for (int i = 0; i < 100000; ++i) text += "<a>";
  expect_unreadable(parse(text), "no well-formed XML");
}

}  // namespace dismantle
