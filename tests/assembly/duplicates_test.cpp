// SPDX-License-Identifier: Apache-2.0
#include "dismantle/assembly/duplicates.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

Assembly boxes(const std::vector<Vec3>& places) {
  Assembly assembly = scenes::assembly({});
  const Component one = scenes::component("box", scenes::box({0, 0, 0}, {1, 2, 3}));
  for (const Vec3& place : places) {
    Component c = one;
    c.name += std::to_string(assembly.components.size());
    c.assembly_from_mesh.translation = place;
    assembly.components.push_back(std::move(c));
  }
  return assembly;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> found_in(const Assembly& assembly) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  for (const Duplicate& d : find_duplicates(assembly)) found.emplace_back(d.component.value, d.of.value);
  return found;
}

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

TEST(Duplicates, AreIdenticalAndInTheSamePlace) {
  EXPECT_EQ(found_in(boxes({{0, 0, 0}, {5, 0, 0}, {0, 0, 0}, {5, 0, 0}, {5, 0, 0}})), (Pairs{{2, 0}, {3, 1}, {4, 1}}));
  EXPECT_TRUE(found_in(boxes({{0, 0, 0}, {0, 0, 0.001}, {0, 0.001, 0}})).empty());
  EXPECT_EQ(found_in(boxes({{0, 0, 0}, {1e-7, 0, 1e-7}})), (Pairs{{1, 0}}));
  EXPECT_TRUE(found_in(boxes({})).empty());
}

TEST(Duplicates, MayHaveMeshesOfTheirOwn) {
  Assembly assembly = boxes({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  assembly.components[1].mesh = std::make_shared<const TriangleMesh>(*assembly.components[0].mesh);
  TriangleMesh other = *assembly.components[0].mesh;
  other.vertices.back() += Vec3{0.1, 0, 0};
  assembly.components[2].mesh = std::make_shared<const TriangleMesh>(other);
  TriangleMesh inside_out = *assembly.components[0].mesh;
  for (Face& f : inside_out.faces) std::swap(f.v[1], f.v[2]);
  assembly.components[3].mesh = std::make_shared<const TriangleMesh>(inside_out);
  EXPECT_EQ(found_in(assembly), (Pairs{{1, 0}}));
}

TEST(Duplicates, CanBeRemoved) {
  Assembly assembly = boxes({{0, 0, 0}, {5, 0, 0}, {0, 0, 0}, {9, 0, 0}});
  remove_components(assembly, std::vector<ComponentId>{ComponentId(2)});
  ASSERT_EQ(assembly.components.size(), 3u);
  EXPECT_EQ(assembly.components[2].name, "box3");
  EXPECT_TRUE(found_in(assembly).empty());
}

}  // namespace
}  // namespace dismantle
