// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/math/mat3.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// The numbers that glTF gives to types of values and of primitives.
enum class GltfScalar { Int8 = 5120, UInt8 = 5121, Int16 = 5122, UInt16 = 5123, UInt32 = 5125, Float32 = 5126 };
enum class GltfMode { Triangles = 4, Strip = 5, Fan = 6 };

std::size_t byte_size(GltfScalar scalar);

struct GltfBuffer {
  std::optional<std::string> uri;  ///< None: the binary chunk of a GLB.
  std::size_t length = 0;          ///< [bytes]
};

struct GltfView {
  std::size_t buffer = 0, offset = 0, length = 0;
  std::size_t stride = 0;  ///< 0: tightly packed
};

struct GltfSparse {
  std::size_t count = 0;
  std::size_t index_view = 0, index_offset = 0;
  GltfScalar index_scalar = GltfScalar::UInt32;
  std::size_t value_view = 0, value_offset = 0;
};

struct GltfAccessor {
  std::optional<std::size_t> view;  ///< None: zeros
  std::size_t offset = 0, count = 0;
  GltfScalar scalar = GltfScalar::Float32;
  int width = 1;  ///< Values an element: 1 scalar, 3 VEC3; others are 0, for nothing here needs them.
  bool normalized = false;
  std::optional<GltfSparse> sparse;
};

struct GltfPrimitive {
  GltfMode mode = GltfMode::Triangles;
  std::size_t positions = 0;           ///< accessor
  std::optional<std::size_t> indices;  ///< accessor
  std::optional<std::size_t> material;
};

struct GltfMesh {
  std::string name;
  std::vector<GltfPrimitive> primitives;  ///< Those of triangles; points and lines are left out.
};

/// x -> linear * x + translation, in metres.
struct GltfTransform {
  Mat3 linear;
  Vec3 translation;
};

struct GltfNode {
  std::string name;
  std::optional<std::size_t> mesh;
  std::vector<std::size_t> children;
  GltfTransform parent_from_node;
};

/// What dismantle needs of a glTF 2.0 document. Every index lies within its array; offsets and lengths are as the
/// file claims and still to be compared with the bytes that there are. No node has two parents, none is its own.
struct GltfDocument {
  std::vector<GltfBuffer> buffers;
  std::vector<GltfView> views;
  std::vector<GltfAccessor> accessors;
  std::vector<Color> materials;
  std::vector<GltfMesh> meshes;
  std::vector<GltfNode> nodes;
  std::vector<std::size_t> roots;  ///< Of the default scene, or all nodes without a parent.
};

/// Reads the JSON part of a glTF file. Errors: Unreadable where it is no glTF 2, breaks the rules above, or needs an
/// extension that dismantle does not know (the compressions among them), by name.
Result<GltfDocument> parse_gltf(std::string_view text, const std::string& file_name);

}  // namespace dismantle
