// SPDX-License-Identifier: Apache-2.0
// Files that are broken, truncated, or claim data that they do not have: one Error each.
#include "dismantle/formats/gltf/gltf_import.h"
#include "tests/formats/gltf_files.h"
#include "tests/support/parse_expectations.h"

#include <gtest/gtest.h>

#include <random>

namespace dismantle {
namespace {

Result<Assembly> import(std::string_view bytes, const ImportOptions& options = {}) {
  const auto no_files = [](const std::string& uri, std::size_t) -> Result<std::string> {
    return Error{ErrorKind::Unreadable, "no file " + uri};
  };
  return import_gltf(bytes, "hostile.glb", no_files, options);
}

/// The Error for a tetrahedron whose JSON has `from` replaced by `to`; empty if it can be read.
std::string error_with(const std::string& from, const std::string& to, const std::string& nodes = R"({"mesh": 0})",
                       const std::string& more = "") {
  std::string json = tetrahedron_json(nodes, more);
  const std::size_t at = json.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  json.replace(at, from.size(), to);
  const Result<Assembly> a = import(glb_of(json, tetrahedron_bytes()));
  return a ? "" : a.error().message;
}

void expect_contains(const std::string& message, std::string_view part) {
  EXPECT_NE(message.find(part), std::string::npos) << "\"" << message << "\" lacks \"" << part << "\"";
}

TEST(ReadGltfHostile, RefusesClaimsBeyondTheBytes) {
  expect_contains(error_with("\"count\": 4", "\"count\": 5"), "reaches beyond its bytes");
  expect_contains(error_with("\"count\": 4", "\"count\": 900000000000"), "reaches beyond its bytes");
  expect_contains(error_with("\"count\": 4", "\"count\": 18446744073709551615"), "reaches beyond its bytes");
  expect_contains(error_with("\"count\": 4", "\"count\": -4"), "not a whole number");
  expect_contains(error_with("\"count\": 4", "\"count\": 4, \"byteOffset\": 18446744073709551612"), "beyond its bytes");
  expect_contains(error_with("\"byteLength\": 48", "\"byteLength\": 10000000000"), "reaches beyond its bytes");
  expect_contains(error_with("\"byteLength\": 72", "\"byteLength\": 10000000000"), "has 72 bytes of 10000000000");
  expect_contains(error_with("\"byteOffset\": 48", "\"byteOffset\": 18446744073709551600"), "reaches beyond its bytes");
  expect_contains(error_with("\"byteLength\": 48", "\"byteLength\": 48, \"byteStride\": 18446744073709551615"),
                  "reaches beyond its bytes");
  expect_contains(error_with("\"bufferView\": 0, \"componentType\": 5126, \"count\": 4",
                             "\"componentType\": 5126, \"count\": 10000000000"),
                  "has no bytes for what it claims");
}

TEST(ReadGltfHostile, RefusesIndicesOutOfRange) {
  expect_contains(error_with("\"POSITION\": 0", "\"POSITION\": 2"), "there is no such one");
  expect_contains(error_with("\"buffer\": 0", "\"buffer\": 7"), "there is no such one");
  expect_contains(error_with("\"mesh\": 0", "\"mesh\": 1"), "there is no such one");
  expect_contains(error_with("\"count\": 4", "\"count\": 3"), "has an index beyond its positions");
  expect_contains(error_with("\"count\": 12, \"type\": \"SCALAR\"", "\"count\": 4, \"type\": \"VEC3\""),
                  "its indices are no whole numbers");
  expect_contains(error_with("\"type\": \"VEC3\"", "\"type\": \"MAT4\""), "no vectors of three");
}

TEST(ReadGltfHostile, RefusesNodesInCyclesOrWithTwoParents) {
  EXPECT_NE(error_with("asset", "asset", R"({"children": [1]}, {"children": [0], "mesh": 0})"), "");
  EXPECT_NE(error_with("asset", "asset", R"({"children": [0], "mesh": 0})"), "");
  expect_contains(error_with("asset", "asset", R"({"children": [2]}, {"children": [2]}, {"mesh": 0})"), "two parents");
  expect_contains(error_with("asset", "asset", R"({"children": [1, 1]}, {"mesh": 0})"), "two parents");
  expect_contains(error_with("asset", "asset", R"({"mesh": 0})", R"(, "scenes": [{"nodes": [0, 0]}])"), "twice");
}

TEST(ReadGltfHostile, ReadsAChainOfManyNodesWithoutRecursion) {
  std::string nodes;
  const int depth = 30000;
  for (int i = 0; i < depth; ++i) nodes += "{\"children\": [" + std::to_string(i + 1) + "]},";
  const Result<Assembly> a = import(glb_of(tetrahedron_json(nodes + R"({"mesh": 0})"), tetrahedron_bytes()));
  ASSERT_TRUE(a.ok()) << a.error().message;
  EXPECT_EQ(a->tree.size(), depth + 1u);
}

TEST(ReadGltfHostile, NamesTheUnsupportedExtension) {
  for (const char* name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "VENDOR_magic"})
    expect_contains(
        error_with("asset", "asset", R"({"mesh": 0})", ", \"extensionsRequired\": [\"" + std::string(name) + "\"]"),
        name);
  EXPECT_EQ(error_with("asset", "asset", R"({"mesh": 0})", R"(, "extensionsRequired": ["KHR_materials_unlit"])"), "");
  std::string json = tetrahedron_json(R"({"mesh": 0})");
  json.replace(json.find("\"bufferView\": 0, "), 17, "");
  json.replace(json.find("\"indices\": 1"), 12,
               "\"indices\": 1, \"extensions\": {\"KHR_draco_mesh_compression\": {\"bufferView\": 0}}");
  expect_contains(import(glb_of(json, tetrahedron_bytes())).error().message, "KHR_draco_mesh_compression");
}

TEST(ReadGltfHostile, RefusesOtherVersionsAndNonsense) {
  expect_contains(error_with("\"2.0\"", "\"1.0\""), "reads glTF 2");
  expect_contains(import("").error().message, "no well-formed JSON");
  expect_contains(import("not a gltf").error().message, "no well-formed JSON");
  expect_contains(import("[]").error().message, "not an object");
  expect_contains(import("{}").error().message, "asset");
  expect_contains(import("{\"asset\": {\"version\": \"2.0\"}}").error().message, "holds no component");
  expect_contains(import(std::string(200000, '[')).error().message, "no well-formed JSON");
  expect_contains(error_with("asset", "asset", R"({"mesh": 0, "translation": [1e8, 0, 0]})"), "check the units");
  expect_contains(error_with("asset", "asset", R"({"mesh": 0, "scale": [1e300, 0, 0]})"), "beyond 1e9");
}

TEST(ReadGltfHostile, RefusesEveryPrefixOfABinaryFile) {
  const std::string whole = glb_of(tetrahedron_json(R"({"mesh": 0})"), tetrahedron_bytes());
  ASSERT_TRUE(import(whole).ok());
  for (std::size_t size = 0; size < whole.size(); ++size) EXPECT_FALSE(import(whole.substr(0, size)).ok()) << size;
}

TEST(ReadGltfHostile, KeepsTheLimits) {
  ImportOptions options;
  const std::string glb = glb_of(tetrahedron_json(R"({"mesh": 0}, {"mesh": 0}, {"mesh": 0})"), tetrahedron_bytes());
  options.limits.triangles = 11;
  expect_contains(import(glb, options).error().message, "too large");
  options.limits.triangles = 3;
  expect_contains(import(glb, options).error().message, "more than 3 triangles");
  options.limits = {};
  options.limits.components = 2;
  expect_contains(import(glb, options).error().message, "too large");
  options.limits.components = 3;
  EXPECT_TRUE(import(glb, options).ok());
}

TEST(ReadGltfHostile, ReadsOrRefusesFilesWithChangedBytes) {
  const std::string whole =
      glb_of(tetrahedron_json(R"({"mesh": 0, "rotation": [0, 0, 1, 0]}, {"mesh": 0})"), tetrahedron_bytes());
  const unsigned seed = 99;
  std::mt19937 random(seed);
  const int rounds = 20000;
  int read = 0;
  for (int round = 0; round < rounds; ++round) {
    std::string changed = whole;
    for (unsigned k = 0; k <= random() % 4; ++k) {
      char& c = changed[random() % changed.size()];
      c = random() % 2 ? static_cast<char>(random()) : "0123456789{}[],:\" "[random() % 18];
    }
    const Result<Assembly> a = import(changed);
    if (!a) {
      expect_unreadable(a, "");
      continue;
    }
    ++read;
    for (const Component& component : a->components) {
      const std::size_t count = component.mesh->vertices.size();
      for (const Face& face : component.mesh->faces)
        for (const std::uint32_t vertex : face.v) ASSERT_LT(vertex, count) << "round " << round;
      for (const Vec3& vertex : component.mesh->vertices) ASSERT_TRUE(is_finite(vertex)) << "round " << round;
    }
  }
  std::printf("seed %u: %d of %d changed files could still be read\n", seed, read, rounds);
  EXPECT_GT(read, 0);
  EXPECT_LT(read, rounds);
}

}  // namespace
}  // namespace dismantle
