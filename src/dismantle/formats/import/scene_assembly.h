// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"
#include "dismantle/math/mat3.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace dismantle {

/// The affine map x -> linear * x + translation.
struct SceneTransform {
  Mat3 linear;       ///< Rotation, scale and shear.
  Vec3 translation;  ///< In the file's units.
};

/// The map that applies `b`, then `a`.
SceneTransform operator*(const SceneTransform& a, const SceneTransform& b);

/// A node of a scene graph.
struct SceneNode {
  std::string name;                   ///< Empty if the file gives none.
  std::optional<std::size_t> mesh;    ///< Index of its mesh.
  std::vector<std::size_t> children;  ///< Indices of nodes.
  SceneTransform parent_from_node;    ///< Local transform.
};

/// A scene graph: the nodes of a file that has meshes and places them. Every index is below the number of nodes. A node
/// that is the child of several occurs below each of them.
struct Scene {
  std::vector<SceneNode> nodes;    ///< In any order.
  std::vector<std::size_t> roots;  ///< Indices of nodes.
};

/// The triangles of a mesh, in the file's units, not welded or cleaned; every index is below the vertex count.
struct SceneMesh {
  TriangleMesh mesh;  ///< In the file's units.
  Color color;        ///< Of the largest part of its surface.
};

/// The mesh of an index. Errors: Unreadable, also if it has more than `triangle_limit` triangles.
using SceneMeshLoader = std::function<Result<SceneMesh>(std::size_t mesh, std::size_t triangle_limit)>;

/// The file that a scene is read from.
struct SceneFile {
  std::string name;                 ///< Without its folder.
  double millimetres_per_unit = 1;  ///< Of its coordinates.
};

/// Makes a component of each occurrence of a node with a mesh, named after the node, and the product tree of the nodes.
/// Meshes are loaded once each and shared by occurrences; scale, shear and mirroring go into the mesh. Errors:
/// Unreadable if there is no component, a coordinate is larger than kLargestCoordinate, or a limit is exceeded, which
/// covers nodes that are their own ancestors; Failed if cancelled; those of `load`.
Result<Assembly> assembly_from_scene(const Scene& scene, const SceneFile& file, const SceneMeshLoader& load,
                                     const ImportOptions& options);

}  // namespace dismantle
