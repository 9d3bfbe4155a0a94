// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/gltf/write_glb.h"

#include "dismantle/formats/gltf/read_gltf.h"
#include "tests/support/check_glb.h"
#include "tests/support/meshes.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cmath>

namespace dismantle {
namespace {

/// A base with two instances of a tube on it, one of them in another colour; names that need care in JSON.
Assembly scene() {
  Assembly a = scenes::assembly({scenes::component("base \"0\" ä", scenes::box({-50, -40, 0}, {50, 40, 7.3})),
                                 scenes::component("tube", scenes::tube(5.1, 3.3, 0, 10, 24))});
  a.components[1].assembly_from_mesh = transform_from_pose({{20, 10, 7.3}, quat_about({0, 0, 1}, 0.7)});
  a.components[1].color = {0.8f, 0.3f, 0.1f, 1};
  Component second = a.components[1];
  second.name = "tube#2";
  second.color = {0.1f, 0.3f, 0.8f, 0.5f};
  second.assembly_from_mesh = transform_from_pose({{-20, 10, 7.3}, quat_about({0, 1, 0}, -2.1)});
  second.tree_node = static_cast<std::uint32_t>(a.tree.size());
  a.tree.push_back({"tube", 0});
  a.components.push_back(second);
  return a;
}

/// Component by component in order, vertices within the rounding of floats.
void expect_same(const Assembly& a, const Assembly& b) {
  ASSERT_EQ(a.components.size(), b.components.size());
  for (std::size_t i = 0; i < a.components.size(); ++i) {
    EXPECT_EQ(a.components[i].name, b.components[i].name);
    EXPECT_EQ(a.components[i].mesh->faces, b.components[i].mesh->faces);
    EXPECT_NEAR(a.components[i].color.r, b.components[i].color.r, 1e-6);
    EXPECT_NEAR(a.components[i].color.b, b.components[i].color.b, 1e-6);
    EXPECT_EQ(a.components[i].color.a, b.components[i].color.a);
    const std::vector<Vec3> p = assembled_vertices(a.components[i]), q = assembled_vertices(b.components[i]);
    ASSERT_EQ(p.size(), q.size());
    for (std::size_t k = 0; k < p.size(); ++k) ASSERT_LT(max_abs(p[k] - q[k]), 1e-5) << i;
  }
}

TEST(WriteGlb, ReadsBackEqualToFloatPrecision) {
  const ScratchFolder folder;
  const Assembly a = scene();
  ASSERT_TRUE(write_glb(a, folder / "scene.glb").ok());
  const Result<Assembly> b = read_gltf(folder / "scene.glb", {});
  ASSERT_TRUE(b.ok()) << b.error().message;
  expect_same(a, *b);
  ASSERT_EQ(b->tree.size(), a.tree.size());
  EXPECT_EQ(b->tree[0].name, "scene");

  ASSERT_TRUE(write_glb(*b, folder / "again.glb").ok());
  const Result<Assembly> c = read_gltf(folder / "again.glb", {});
  ASSERT_TRUE(c.ok()) << c.error().message;
  expect_same(*b, *c);
}

TEST(WriteGlb, PlacesComponentsAtTheirPoses) {
  const ScratchFolder folder;
  Assembly a = scene();
  GlbOptions options;
  options.poses = {{}, {{1, 2, 3}, quat_about({1, 0, 0}, 0.4)}, {{0, 0, 99}, {}}};
  ASSERT_TRUE(write_glb(a, folder / "posed.glb", options).ok());
  const Result<Assembly> b = read_gltf(folder / "posed.glb", {});
  ASSERT_TRUE(b.ok()) << b.error().message;
  for (std::size_t i = 0; i < 3; ++i)
    a.components[i].assembly_from_mesh = transform_from_pose(options.poses[i]) * a.components[i].assembly_from_mesh;
  expect_same(a, *b);
}

TEST(WriteGlb, IsUnderstoodByAnotherReader) {
  const Result<std::string> glb = glb_from_assembly(scene());
  ASSERT_TRUE(glb.ok());
  tinygltf::TinyGLTF loader;
  tinygltf::Model model;
  std::string problem, warning;
  ASSERT_TRUE(loader.LoadBinaryFromMemory(&model, &problem, &warning,
                                          reinterpret_cast<const unsigned char*>(glb->data()),
                                          static_cast<unsigned>(glb->size()), "", tinygltf::REQUIRE_ALL))
      << problem;
  EXPECT_EQ(problem + warning, "");
  ASSERT_EQ(model.nodes.size(), 4u);
  EXPECT_EQ(model.nodes[0].children, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(model.nodes[1].name, "base \"0\" ä");
  EXPECT_EQ(model.nodes[3].extras.Get("component").Get<std::string>(), "tube#2");
  EXPECT_EQ(model.meshes.size(), 3u);     // two for the tube's two colours
  EXPECT_EQ(model.accessors.size(), 4u);  // which share their positions and indices
  EXPECT_EQ(model.accessors[0].count, 8u);
  EXPECT_FLOAT_EQ(static_cast<float>(model.accessors[0].maxValues[0]), 0.05f);
  EXPECT_EQ(model.materials.size(), 3u);
  EXPECT_EQ(model.materials[2].alphaMode, "BLEND");
}

TEST(WriteGlb, IsValid) {
  EXPECT_EQ(CheckedGlb(*glb_from_assembly(scene())).faults(), std::vector<std::string>{});
  EXPECT_EQ(CheckedGlb(*glb_from_assembly(Assembly{})).faults(), std::vector<std::string>{});
}

TEST(WriteGlb, OmitsAnAnimationWithoutMotion) {
  GlbOptions options;
  options.animations = {{"rest", {{ComponentId(1), {{0, {}}, {1, {}}}}}}};
  EXPECT_FALSE(CheckedGlb(*glb_from_assembly(scene(), options)).json().contains("animations"));
}

TEST(WriteGlb, MakesANodeOfEachComponentOfATreeNode) {
  const ScratchFolder folder;
  Assembly a = scene();
  a.tree = {{"all", 0}};
  for (Component& c : a.components) c.tree_node = 0;
  ASSERT_TRUE(write_glb(a, folder / "flat.glb").ok());
  const Result<Assembly> b = read_gltf(folder / "flat.glb", {});
  ASSERT_TRUE(b.ok()) << b.error().message;
  expect_same(a, *b);
}

TEST(WriteGlb, UsesWideIndicesForLargeMeshes) {
  const ScratchFolder folder;
  const Assembly a = scenes::assembly({scenes::component("fine", scenes::tube(5, 3, 0, 10, 400, 90))});
  ASSERT_GT(a.components[0].mesh->vertices.size(), 65535u);
  ASSERT_TRUE(write_glb(a, folder / "fine.glb").ok());
  const Result<Assembly> b = read_gltf(folder / "fine.glb", {});
  ASSERT_TRUE(b.ok()) << b.error().message;
  expect_same(a, *b);
}

TEST(WriteGlb, FailsIfTheFolderIsMissing) {
  const ScratchFolder folder;
  const Result<Done> written = write_glb(scene(), folder / "nowhere" / "a.glb");
  ASSERT_FALSE(written.ok());
  EXPECT_EQ(written.error().kind, ErrorKind::Failed);
}

}  // namespace
}  // namespace dismantle
