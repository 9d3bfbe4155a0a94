// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/gltf/read_gltf.h"

#include "dismantle/files/sha256.h"
#include "tests/formats/gltf_files.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

Result<Assembly> read(const ScratchFolder& folder, const std::string& glb, const ImportOptions& options = {}) {
  return read_gltf(folder.put("model.glb", glb), options);
}

Result<Assembly> read_nodes(const std::string& nodes, const std::string& more = "", const ImportOptions& options = {}) {
  const ScratchFolder folder;
  return read(folder, glb_of(tetrahedron_json(nodes, more), tetrahedron_bytes()), options);
}

void expect_box(const Component& c, Vec3 lower, Vec3 upper, double tolerance = 1e-9) {
  const Aabb box = assembled_bounds(c);
  EXPECT_LE(max_abs(box.lower - lower), tolerance) << c.name;
  EXPECT_LE(max_abs(box.upper - upper), tolerance) << c.name;
}

/// A file of one primitive that draws positions as `mode` says.
Assembly read_primitive(const std::string& accessors, const std::string& views, const std::string& primitive,
                        const std::string& bytes) {
  const ScratchFolder folder;
  const Result<Assembly> a = read(
      folder, glb_of(R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": )" + std::to_string(bytes.size()) +
                         R"(}], "bufferViews": [)" + views + R"(], "accessors": [)" + accessors +
                         R"(], "meshes": [{"primitives": [)" + primitive + R"(]}], "nodes": [{"mesh": 0}]})",
                     bytes));
  EXPECT_TRUE(a.ok()) << a.error().message;
  return a ? *a : Assembly{};
}

TEST(ReadGltf, MakesAComponentOfEachMeshNodeInMillimetres) {
  const ScratchFolder folder;
  const std::string glb = glb_of(
      tetrahedron_json(R"({"name": "foot", "mesh": 0}, {"mesh": 0, "translation": [2, 0, 0]}, {"name": "lamp"})"),
      tetrahedron_bytes());
  const Result<Assembly> a = read(folder, glb);
  ASSERT_TRUE(a.ok()) << a.error().message;
  EXPECT_EQ(a->source_file, "model.glb");
  EXPECT_EQ(a->source_sha256, sha256(glb));
  EXPECT_EQ(a->source_units, "m");
  EXPECT_EQ(a->deflection, 0);
  ASSERT_EQ(a->components.size(), 2u);
  EXPECT_EQ(a->components[0].name, "foot");
  EXPECT_EQ(a->components[1].name, "tetra");
  EXPECT_EQ(a->components[0].mesh, a->components[1].mesh);
  EXPECT_TRUE(a->components[0].faults.closed());
  EXPECT_FALSE(a->components[0].faults.inside_out);
  expect_box(a->components[0], {0, 0, 0}, {1000, 1000, 1000});
  expect_box(a->components[1], {2000, 0, 0}, {3000, 1000, 1000});
}

TEST(ReadGltf, ComposesTransformsDownTheTree) {
  // A quarter turn about z at x = 10, and in it a translation of 1 along x.
  const Result<Assembly> a = read_nodes(R"({"name": "arm", "translation": [10, 0, 0], "children": [1],
      "rotation": [0, 0, 0.70710678118654757, 0.70710678118654757]},
      {"name": "hand", "mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 1,0,0,1]})");
  ASSERT_TRUE(a.ok()) << a.error().message;
  ASSERT_EQ(a->components.size(), 1u);
  expect_box(a->components[0], {9000, 1000, 0}, {10000, 2000, 1000});
  ASSERT_EQ(a->tree.size(), 2u);
  EXPECT_EQ(a->tree[0].name, "arm");
  EXPECT_EQ(a->tree[a->components[0].tree_node].name, "hand");
}

TEST(ReadGltf, BakesScalesShearsAndMirroringsIntoTheMesh) {
  const Result<Assembly> a =
      read_nodes(R"({"name": "rigid", "mesh": 0}, {"name": "double", "mesh": 0, "scale": [2, 2, 2]},
      {"name": "mirrored", "mesh": 0, "scale": [-1, 1, 1]}, {"name": "inverted", "mesh": 0, "scale": [-1, -1, -1]},
      {"name": "sheared", "mesh": 0, "matrix": [1,0,0,0, 0.5,1,0,0, 0,0,3,0, 0,0,0,1]},
      {"name": "turned double", "mesh": 0, "scale": [2, 2, 2], "rotation": [1, 0, 0, 0]})");
  ASSERT_TRUE(a.ok()) << a.error().message;
  ASSERT_EQ(a->components.size(), 6u);
  const double volumes[] = {1, 8, 1, 1, 3, 8};
  for (std::size_t i = 0; i < 6; ++i) {
    const Component& c = a->components[i];
    EXPECT_NEAR(determinant(c.assembly_from_mesh.rotation), 1, 1e-12) << c.name;
    EXPECT_NEAR(signed_volume(assembled_mesh(c)), volumes[i] * 1e9 / 6, 1) << c.name;
  }
  expect_box(a->components[2], {-1000, 0, 0}, {0, 1000, 1000});
  expect_box(a->components[3], {-1000, -1000, -1000}, {0, 0, 0});
  expect_box(a->components[4], {0, 0, 0}, {1000, 1000, 3000});
  expect_box(a->components[5], {0, -2000, -2000}, {2000, 0, 0});
  EXPECT_EQ(a->components[1].mesh, a->components[5].mesh);
}

TEST(ReadGltf, LetsTheUserOverrideTheUnits) {
  ImportOptions options;
  options.units = "in";
  const Result<Assembly> a = read_nodes(R"({"mesh": 0, "translation": [1, 0, 0]})", "", options);
  ASSERT_TRUE(a.ok()) << a.error().message;
  expect_box(a->components[0], {25.4, 0, 0}, {50.8, 25.4, 25.4});
  options.units = "cubit";
  EXPECT_EQ(read_nodes(R"({"mesh": 0})", "", options).error().kind, ErrorKind::Usage);
}

TEST(ReadGltf, ReadsTheDefaultSceneOnly) {
  const Result<Assembly> a = read_nodes(R"({"name": "in", "mesh": 0}, {"name": "out", "mesh": 0})",
                                        R"(, "scene": 1, "scenes": [{"nodes": [1]}, {"nodes": [0]}])");
  ASSERT_TRUE(a.ok()) << a.error().message;
  ASSERT_EQ(a->components.size(), 1u);
  EXPECT_EQ(a->components[0].name, "in");
}

TEST(ReadGltf, TurnsLinearBaseColoursIntoSrgb) {
  const ScratchFolder folder;
  std::string json = tetrahedron_json(R"({"mesh": 0})", R"(, "materials": [{"alphaMode": "BLEND",
      "pbrMetallicRoughness": {"baseColorFactor": [1, 0.21404114, 0, 0.5]}}])");
  json.replace(json.find("\"indices\": 1"), 12, "\"indices\": 1, \"material\": 0");
  const Result<Assembly> a = read(folder, glb_of(json, tetrahedron_bytes()));
  ASSERT_TRUE(a.ok()) << a.error().message;
  EXPECT_NEAR(a->components[0].color.r, 1, 1e-6);
  EXPECT_NEAR(a->components[0].color.g, 0.5, 1e-6);
  EXPECT_EQ(a->components[0].color.b, 0);
  EXPECT_EQ(a->components[0].color.a, 0.5f);
}

TEST(ReadGltf, FindsBuffersBesideTheFileAndInDataUris) {
  const ScratchFolder folder;
  folder.put("my parts.bin", tetrahedron_bytes());
  const auto with_uri = [](const std::string& uri) {
    return tetrahedron_json(R"({"mesh": 0})", "", R"({"byteLength": 72, "uri": ")" + uri + "\"}");
  };
  const Result<Assembly> beside = read_gltf(folder.put("a.gltf", with_uri("my%20parts.bin")), {});
  ASSERT_TRUE(beside.ok()) << beside.error().message;
  const Result<Assembly> within =
      read_gltf(folder.put("b.gltf", with_uri("data:application/octet-stream;base64,"
                                              "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/"
                                              "AAACAAEAAAABAAMAAAADAAIAAQACAAMA")),
                {});
  ASSERT_TRUE(within.ok()) << within.error().message;
  EXPECT_EQ(*beside->components[0].mesh, *within->components[0].mesh);
  const Result<Assembly> missing = read_gltf(folder.put("c.gltf", with_uri("gone.bin")), {});
  EXPECT_NE(missing.error().message.find("gone.bin"), std::string::npos);
  const Result<Assembly> remote = read_gltf(folder.put("d.gltf", with_uri("https://example.com/x.bin")), {});
  EXPECT_NE(remote.error().message.find("nothing is fetched"), std::string::npos);
}

TEST(ReadGltf, DrawsStripsFansAndUnindexedTriangles) {
  const std::string square = bytes_from(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
  const std::string view = R"({"buffer": 0, "byteLength": 48})";
  const std::string accessor = R"({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"})";
  const Assembly strip = read_primitive(accessor, view, R"({"attributes": {"POSITION": 0}, "mode": 5})", square);
  ASSERT_EQ(triangle_count(strip), 2u);
  for (std::size_t f = 0; f < 2; ++f)
    EXPECT_EQ(normal_unscaled(strip.components[0].mesh->triangle(f)), (Vec3{0, 0, 1e6}));

  const std::string turned = bytes_from(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  const Assembly fan = read_primitive(accessor, view, R"({"attributes": {"POSITION": 0}, "mode": 6})", turned);
  ASSERT_EQ(triangle_count(fan), 2u);
  for (std::size_t f = 0; f < 2; ++f)
    EXPECT_EQ(normal_unscaled(fan.components[0].mesh->triangle(f)), (Vec3{0, 0, 1e6}));

  const Assembly plain = read_primitive(accessor, view, R"({"attributes": {"POSITION": 0}})", square);
  EXPECT_EQ(triangle_count(plain), 1u);  // the fourth corner starts no triangle
}

TEST(ReadGltf, ReadsIndicesOfEverySize) {
  const std::string corners = bytes_from(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});
  const auto read_indices = [&](const std::string& bytes, int type) {
    return read_primitive(R"({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                             {"bufferView": 1, "componentType": )" +
                              std::to_string(type) + R"(, "count": 3, "type": "SCALAR"})",
                          R"({"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": )" +
                              std::to_string(bytes.size()) + "}",
                          R"({"attributes": {"POSITION": 0}, "indices": 1})", corners + bytes);
  };
  for (const Assembly& a : {read_indices(bytes_from(std::vector<std::uint8_t>{0, 2, 1}), 5121),
                            read_indices(bytes_from(std::vector<std::uint16_t>{0, 2, 1}), 5123),
                            read_indices(bytes_from(std::vector<std::uint32_t>{0, 2, 1}), 5125)}) {
    ASSERT_EQ(triangle_count(a), 1u);
    EXPECT_EQ(normal_unscaled(a.components[0].mesh->triangle(0)), (Vec3{0, 0, -1e6}));
  }
}

TEST(ReadGltf, ReadsStridedNormalizedAndSparsePositions) {
  // Each position of three int16 has two bytes of padding; 32767 is 1.
  const std::string quantized = bytes_from(std::vector<std::int16_t>{0, 0, 0, 9, 32767, 0, 0, 9, 0, -32768, 0, 9});
  const Assembly a = read_primitive(
      R"({"bufferView": 0, "componentType": 5122, "normalized": true, "count": 3, "type": "VEC3"})",
      R"({"buffer": 0, "byteLength": 24, "byteStride": 8})", R"({"attributes": {"POSITION": 0}})", quantized);
  expect_box(a.components[0], {0, -1000, 0}, {1000, 0, 0});

  // Zeros, of which the second and third are replaced.
  const std::string sparse = bytes_from(std::vector<float>{2, 0, 0, 0, 3, 0}) + std::string("\1\2", 2);
  const Assembly b = read_primitive(
      R"({"componentType": 5126, "count": 3, "type": "VEC3", "sparse": {"count": 2,
          "indices": {"bufferView": 1, "componentType": 5121}, "values": {"bufferView": 0}}})",
      R"({"buffer": 0, "byteLength": 24}, {"buffer": 0, "byteOffset": 24, "byteLength": 2})",
      R"({"attributes": {"POSITION": 0}})", sparse);
  expect_box(b.components[0], {0, 0, 0}, {2000, 3000, 0});
}

TEST(ReadGltf, LeavesOutPointsAndLines) {
  const std::string corners = bytes_from(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});
  const Assembly a = read_primitive(R"({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"})",
                                    R"({"buffer": 0, "byteLength": 36})",
                                    R"({"attributes": {"POSITION": 0}, "mode": 1}, {"attributes": {"POSITION": 0}},
                                       {"attributes": {"POSITION": 0}, "mode": 0})",
                                    corners);
  EXPECT_EQ(triangle_count(a), 1u);
}

}  // namespace
}  // namespace dismantle
