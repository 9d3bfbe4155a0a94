// SPDX-License-Identifier: Apache-2.0
#include "dismantle/assembly/assembly_bytes.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

namespace dismantle {
namespace {

std::vector<std::byte> bytes_from(const Assembly& assembly) {
  std::vector<std::byte> bytes;
  write_assembly_bytes(assembly, [&](const void* data, std::size_t size) {
    const auto* first = static_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), first, first + size);
  });
  return bytes;
}

Assembly three_components() {
  Assembly a = scenes::assembly({scenes::component("box", scenes::box({0, 0, 0}, {1, 2, 3})),
                                 scenes::component("tube", scenes::tube(5, 3, 0, 10, 12))});
  a.components.push_back(a.components[0]);
  a.components[2].name = "box#2";
  a.components[2].assembly_from_mesh.translation = {1e-3, -7, 1e9};
  a.components[2].color = {0.1f, 0.2f, 0.3f, 0.4f};
  a.components[2].faults.degenerate_faces = 5;
  a.source_sha256 = "abc";
  a.source_units = "in";
  a.deflection = 0.125;
  a.simplification_error = 0.5;
  return a;
}

TEST(AssemblyBytes, ReadBackEverythingWithSharedMeshes) {
  const Assembly a = three_components();
  const std::optional<Assembly> b = assembly_from_bytes(bytes_from(a));
  ASSERT_TRUE(b);
  EXPECT_EQ(b->source_file, a.source_file);
  EXPECT_EQ(b->source_sha256, a.source_sha256);
  EXPECT_EQ(b->source_units, a.source_units);
  EXPECT_EQ(b->deflection, a.deflection);
  EXPECT_EQ(b->simplification_error, a.simplification_error);
  ASSERT_EQ(b->tree.size(), a.tree.size());
  for (std::size_t i = 0; i < a.tree.size(); ++i) {
    EXPECT_EQ(b->tree[i].name, a.tree[i].name);
    EXPECT_EQ(b->tree[i].parent, a.tree[i].parent);
  }
  ASSERT_EQ(b->components.size(), a.components.size());
  for (std::size_t i = 0; i < a.components.size(); ++i) {
    EXPECT_EQ(b->components[i].name, a.components[i].name);
    EXPECT_EQ(*b->components[i].mesh, *a.components[i].mesh);
    EXPECT_EQ(b->components[i].assembly_from_mesh, a.components[i].assembly_from_mesh);
    EXPECT_EQ(b->components[i].color, a.components[i].color);
    EXPECT_EQ(b->components[i].tree_node, a.components[i].tree_node);
    EXPECT_EQ(b->components[i].faults, a.components[i].faults);
  }
  EXPECT_EQ(b->components[0].mesh, b->components[2].mesh);
  EXPECT_NE(b->components[0].mesh, b->components[1].mesh);
}

TEST(AssemblyBytes, RefuseEveryPrefixAndTrailingBytes) {
  std::vector<std::byte> bytes = bytes_from(three_components());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    ASSERT_FALSE(assembly_from_bytes(Span<const std::byte>(bytes.data(), size))) << size;
  bytes.push_back(std::byte{0});
  EXPECT_FALSE(assembly_from_bytes(bytes));
}

TEST(AssemblyBytes, SurviveChangedBytes) {
  const std::vector<std::byte> bytes = bytes_from(three_components());
  std::mt19937 random(7);
  for (int round = 0; round < 3000; ++round) {
    std::vector<std::byte> changed = bytes;
    for (int k = 0; k < 3; ++k) changed[random() % changed.size()] = static_cast<std::byte>(random());
    const std::optional<Assembly> assembly = assembly_from_bytes(changed);
    if (!assembly) continue;
    for (const Component& c : assembly->components) {
      ASSERT_NE(c.mesh, nullptr);
      ASSERT_LT(c.tree_node, assembly->tree.size());
      for (const Face& f : c.mesh->faces)
        for (const std::uint32_t v : f.v) ASSERT_LT(v, c.mesh->vertices.size());
    }
  }
}

}  // namespace
}  // namespace dismantle
