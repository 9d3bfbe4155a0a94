// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/id.h"
#include "dismantle/geometry/triangle_mesh.h"
#include "dismantle/math/rigid_transform.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// An sRGB colour.
struct Color {
  ///@{ A channel, in [0, 1]; `a` is the opacity.
  float r = 0.7f, g = 0.7f, b = 0.72f, a = 1.0f;
  ///@}
  friend bool operator==(const Color&, const Color&) = default;
};

/// One rigid part of an assembly. Instances of one product share their mesh.
struct Component {
  std::string name;  ///< Unique within the assembly.
  /// The mesh in the component's own frame [mm], cleaned by clean_mesh(); never null.
  std::shared_ptr<const TriangleMesh> mesh;
  RigidTransform assembly_from_mesh;  ///< Pose of the instance in the assembled state.
  Color color;                        ///< Of the whole component.
  std::uint32_t tree_node = 0;        ///< Its leaf in Assembly::tree.
  MeshFaults faults;                  ///< Faults of the mesh as it was read.
};

/// A node of the product tree.
struct TreeNode {
  std::string name;          ///< As in the file.
  std::uint32_t parent = 0;  ///< Index of the parent; the root, node 0, is its own parent.
};

/// A CAD assembly in its assembled state.
struct Assembly {
  std::string source_file;    ///< File name without its folder.
  std::string source_sha256;  ///< Hash of the file; for a folder of meshes, of its files concatenated in load order.
  std::string source_units = "mm";       ///< Unit of the file, as it states or as the user gave it.
  double deflection = 0;                 ///< Linear tessellation deflection [mm]; 0: unknown.
  bool deflection_is_estimated = false;  ///< It is that of meshes, found from their facets (estimated_deflection()).
  double simplification_error = 0;       ///< Bound of the distance by which simplification moved the surface [mm].
  std::vector<TreeNode> tree;            ///< The product tree; node 0 is the root.
  std::vector<Component> components;     ///< Indexed by ComponentId.

  /// A component. @pre `id` is one of this assembly
  const Component& operator[](ComponentId id) const { return components[id.value]; }
  /// The component of a name; nothing where there is none.
  std::optional<ComponentId> find(std::string_view name) const;
};

/// Number of triangles of all components.
std::size_t triangle_count(const Assembly& assembly);

/// The component's vertices in the assembled state [mm, assembly frame]: the coordinates that every collision method
/// and the audit start from.
std::vector<Vec3> assembled_vertices(const Component& component);

/// The component's mesh with its assembled vertices.
TriangleMesh assembled_mesh(const Component& component);

/// The bounding box of the assembled component [mm, assembly frame].
Aabb assembled_bounds(const Component& component);
/// The bounding box of the assembly in its assembled state [mm].
Aabb assembled_bounds(const Assembly& assembly);

/// The tolerance that is used where the user gives none: the larger of 1e-5 of the diagonal and twice the deflection,
/// plus twice the simplification error [mm] (docs/guarantee.md).
double default_tolerance(const Assembly& assembly);

/// Makes the names unique: repeated names get the suffixes "#2", "#3", ... in order; an empty name becomes "unnamed".
void make_names_unique(std::vector<Component>& components);

}  // namespace dismantle
