// SPDX-License-Identifier: Apache-2.0
#include "dismantle/loading/write_assembly.h"

#include "dismantle/loading/load_assembly.h"
#include "tests/support/meshes.h"
#include "tests/support/parse_expectations.h"
#include "tests/support/scratch_folder.h"

namespace dismantle {

namespace {

/// A block, and a ring beside it, rotated, so that its coordinates need all digits.
Assembly two_parts() {
  Component ring = scenes::component("ring 1/3", scenes::tube(1.0 / 3, 0.2, -1, 1, 7));
  ring.assembly_from_mesh = transform_from_pose({{0.1, -20, 3e-7}, normalized(Quat{1, 2, 3, 4})});
  ring.color = {1, 0.5f, 0, 1};
  return scenes::assembly({scenes::component("block", scenes::box({0, 0, 0}, {1, 2, 3})), ring});
}

std::vector<Triangle> triangles(const Assembly& assembly) {
  std::vector<Triangle> all;
  for (const Component& component : assembly.components) {
    const TriangleMesh mesh = assembled_mesh(component);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) all.push_back(mesh.triangle(f));
  }
  return all;
}

}  // namespace

TEST(WriteAssembly, ObjGivesBackTheSameComponents) {
  const ScratchFolder folder;
  const Assembly original = two_parts();
  ASSERT_TRUE(write_assembly(folder / "a.OBJ", original).ok());
  const auto again = load_assembly(folder / "a.OBJ");
  ASSERT_TRUE(again.ok()) << message_of(again);
  ASSERT_EQ(again->components.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(again->components[i].name, original.components[i].name);
    EXPECT_EQ(*again->components[i].mesh, assembled_mesh(original.components[i])) << "bit for bit, in the same order";
  }
  EXPECT_EQ(folder.entry_count(), 1u);
}

TEST(WriteAssembly, DasmGivesBackEverything) {
  const ScratchFolder folder;
  Assembly original = two_parts();
  original.components.push_back(original.components[1]);
  original.components[2].name = "another ring";
  original.source_file = "from.step";
  original.deflection = 0.25;
  ASSERT_TRUE(write_assembly(folder / "a.dasm", original).ok());
  const auto again = load_assembly(folder / "a.dasm");
  ASSERT_TRUE(again.ok()) << message_of(again);
  ASSERT_EQ(again->components.size(), 3u);
  EXPECT_EQ(again->source_file, "from.step");
  EXPECT_EQ(again->deflection, 0.25);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(again->components[i].name, original.components[i].name);
    EXPECT_EQ(*again->components[i].mesh, *original.components[i].mesh);
    EXPECT_EQ(again->components[i].assembly_from_mesh, original.components[i].assembly_from_mesh);
    EXPECT_EQ(again->components[i].color, original.components[i].color);
  }
  EXPECT_EQ(again->components[1].mesh, again->components[2].mesh);

  ImportOptions inches;
  inches.units = "in";
  const auto larger = load_assembly(folder / "a.dasm", inches);
  ASSERT_TRUE(larger.ok()) << message_of(larger);
  EXPECT_DOUBLE_EQ(assembled_bounds(*larger).upper.z, 25.4 * assembled_bounds(original).upper.z);
  EXPECT_EQ(larger->source_units, "in");
}

TEST(WriteAssembly, DasmLosesWhatOtherFormatsDoNotLetIn) {
  const ScratchFolder folder;
  Assembly original = two_parts();
  TriangleMesh faulty = *original.components[0].mesh;
  faulty.faces.push_back({{0, 0, 1}});
  original.components[0].mesh = std::make_shared<const TriangleMesh>(faulty);
  original.components.push_back(original.components[1]);
  original.components[2].mesh = std::make_shared<const TriangleMesh>();
  ASSERT_TRUE(write_assembly(folder / "a.dasm", original).ok());
  const auto again = load_assembly(folder / "a.dasm");
  ASSERT_TRUE(again.ok()) << message_of(again);
  ASSERT_EQ(again->components.size(), 2u);
  EXPECT_EQ(again->components[0].mesh->faces.size(), 12u);
  EXPECT_EQ(again->components[0].faults.degenerate_faces, 1u);

  original.components = {original.components[2]};
  ASSERT_TRUE(write_assembly(folder / "b.dasm", original).ok());
  EXPECT_FALSE(load_assembly(folder / "b.dasm").ok());
  ImportOptions small;
  small.limits.triangles = 10;
  EXPECT_FALSE(load_assembly(folder / "a.dasm", small).ok());
}

TEST(WriteAssembly, NamesThatObjCannotHoldAreChanged) {
  const ScratchFolder folder;
  Assembly assembly = two_parts();
  assembly.components[0].name = " two\nlines\\";
  ASSERT_TRUE(write_assembly(folder / "a.obj", assembly).ok());
  const auto again = load_assembly(folder / "a.obj");
  ASSERT_TRUE(again.ok()) << message_of(again);
  EXPECT_EQ(again->components[0].name, "_two_lines_");
}

TEST(WriteAssembly, BinaryStlGivesBackTheTrianglesInSinglePrecision) {
  const ScratchFolder folder;
  const Assembly original = two_parts();
  ASSERT_TRUE(write_assembly(folder / "a.stl", original).ok());
  EXPECT_EQ(std::filesystem::file_size(folder / "a.stl"), 84 + 50 * triangle_count(original));
  const auto again = load_assembly(folder / "a.stl");
  ASSERT_TRUE(again.ok()) << message_of(again);
  ASSERT_EQ(again->components.size(), 1u);
  const std::vector<Triangle> before = triangles(original), after = triangles(*again);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i)
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_EQ(after[i][corner][axis], static_cast<double>(static_cast<float>(before[i][corner][axis])));
}

TEST(WriteAssembly, AsciiStlGivesBackSolidsWithTheSameTriangles) {
  const ScratchFolder folder;
  const Assembly original = two_parts();
  ASSERT_TRUE(write_assembly(folder / "a.stl", original, {StlForm::Ascii}).ok());
  const auto again = load_assembly(folder / "a.stl");
  ASSERT_TRUE(again.ok()) << message_of(again);
  ASSERT_EQ(again->components.size(), 2u);
  EXPECT_EQ(again->components[1].name, "ring 1/3");
  EXPECT_EQ(triangles(*again), triangles(original));
}

TEST(WriteAssembly, PlyGivesBackTheSameTriangles) {
  const ScratchFolder folder;
  const Assembly original = two_parts();
  ASSERT_TRUE(write_assembly(folder / "a.ply", original).ok());
  const auto again = load_assembly(folder / "a.ply");
  ASSERT_TRUE(again.ok()) << message_of(again);
  EXPECT_EQ(triangles(*again), triangles(original));
}

TEST(WriteAssembly, FolderGivesBackTheSameComponents) {
  const ScratchFolder folder;
  Assembly original = two_parts();
  ASSERT_TRUE(write_assembly(folder / "parts/", original).ok());
  const auto again = load_assembly(folder / "parts");
  ASSERT_TRUE(again.ok()) << message_of(again);
  ASSERT_EQ(again->components.size(), 2u);
  EXPECT_EQ(again->components[1].name, "ring 1_3");
  EXPECT_EQ(triangles(*again), triangles(original));

  original.components[0].name = "ring 1_3";
  ASSERT_TRUE(write_assembly(folder / "clash", original).ok());
  EXPECT_TRUE(std::filesystem::exists(folder / "clash/ring 1_3#2.obj"));
}

TEST(WriteAssembly, NeverWritesIntoAFolderThatIsNotEmpty) {
  const ScratchFolder folder;
  folder.put("parts/mine.txt", "mine");
  const auto refused = write_assembly(folder / "parts", two_parts());
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().kind, ErrorKind::Failed);
  EXPECT_EQ(bytes_of(folder / "parts/mine.txt"), "mine");
  EXPECT_EQ(folder.entry_count(), 1u);
}

TEST(WriteAssembly, SaysWhatItCannotWrite) {
  const ScratchFolder folder;
  const auto unknown = write_assembly(folder / "a.step", two_parts());
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().kind, ErrorKind::Usage);
  for (const char* name : {"missing/a.obj", "missing/a.stl", "missing/a.ply", "missing/a"}) {
    const auto nowhere = write_assembly(folder / name, two_parts());
    ASSERT_FALSE(nowhere.ok()) << name;
    EXPECT_EQ(nowhere.error().kind, ErrorKind::Failed);
  }
  EXPECT_EQ(folder.entry_count(), 0u);
}

}  // namespace dismantle
