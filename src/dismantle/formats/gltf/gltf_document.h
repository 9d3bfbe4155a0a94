// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/scene_assembly.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// Component types of accessors, with the numbers of glTF 2.0.
enum class GltfScalar { Int8 = 5120, UInt8 = 5121, Int16 = 5122, UInt16 = 5123, UInt32 = 5125, Float32 = 5126 };
/// Topologies of triangle primitives, with the numbers of glTF 2.0.
enum class GltfMode { Triangles = 4, Strip = 5, Fan = 6 };

/// The size of one value [bytes].
std::size_t byte_size(GltfScalar scalar);

/// A buffer: a block of bytes inside or beside the document.
struct GltfBuffer {
  std::optional<std::string> uri;  ///< Where its bytes are; none: the binary chunk of a GLB.
  std::size_t length = 0;          ///< [bytes]
};

/// A range of a buffer.
struct GltfView {
  std::size_t buffer = 0;  ///< Index of the buffer.
  std::size_t offset = 0;  ///< Within the buffer [bytes].
  std::size_t length = 0;  ///< [bytes]
  std::size_t stride = 0;  ///< Between elements [bytes]; 0: tightly packed.
};

/// Elements of an accessor that replace those of its view.
struct GltfSparse {
  std::size_t count = 0;                         ///< Number of replaced elements.
  std::size_t index_view = 0;                    ///< View of their indices.
  std::size_t index_offset = 0;                  ///< Within that view [bytes].
  GltfScalar index_scalar = GltfScalar::UInt32;  ///< Type of the indices.
  std::size_t value_view = 0;                    ///< View of their values.
  std::size_t value_offset = 0;                  ///< Within that view [bytes].
};

/// A typed array within a view.
struct GltfAccessor {
  std::optional<std::size_t> view;          ///< None: all zeros.
  std::size_t offset = 0;                   ///< Within the view [bytes].
  std::size_t count = 0;                    ///< Number of elements.
  GltfScalar scalar = GltfScalar::Float32;  ///< Type of its values.
  int width = 1;            ///< Values per element: 1 (SCALAR), 3 (VEC3); 0 for all others, which are not used.
  bool normalized = false;  ///< Integers stand for [-1, 1] or [0, 1].
  std::optional<GltfSparse> sparse;  ///< Replaced elements, if any.
};

/// Triangles with one material.
struct GltfPrimitive {
  GltfMode mode = GltfMode::Triangles;  ///< Topology.
  std::size_t positions = 0;            ///< Accessor of vertex positions.
  std::optional<std::size_t> indices;   ///< Accessor of vertex indices; none: vertices in order.
  std::optional<std::size_t> material;  ///< Index of the material.
};

/// A mesh: primitives that are placed together.
struct GltfMesh {
  std::string name;                       ///< Empty if the file gives none.
  std::vector<GltfPrimitive> primitives;  ///< Those of triangles; points and lines are left out.
};

/// The parts of a glTF 2.0 document that describe shape and structure. Every index is within its array; offsets and
/// lengths are as declared by the file and not yet checked against its bytes (GltfElements::open does). No node has two
/// parents or is its own ancestor.
struct GltfDocument {
  std::vector<GltfBuffer> buffers;      ///< In the order of the file, as all of these.
  std::vector<GltfView> views;          ///< Buffer views.
  std::vector<GltfAccessor> accessors;  ///< Typed arrays.
  std::vector<Color> materials;         ///< Base colours.
  std::vector<GltfMesh> meshes;         ///< Meshes.
  std::vector<SceneNode> nodes;         ///< Scene graph [m].
  std::vector<std::size_t> roots;       ///< Nodes of the default scene, or all nodes without a parent.
};

/// Parses the JSON part of a glTF file. Errors: Unreadable if it is not glTF 2, breaks the rules of GltfDocument, or
/// requires an extension that is not supported (such as compression), which the message names.
Result<GltfDocument> parse_gltf(std::string_view text, const std::string& file_name);

}  // namespace dismantle
