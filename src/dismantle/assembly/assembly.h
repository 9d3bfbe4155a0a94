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

/// sRGB, each channel in [0, 1].
struct Color {
  float r = 0.7f, g = 0.7f, b = 0.72f, a = 1.0f;
  friend bool operator==(const Color&, const Color&) = default;
};

/// One rigid part of an assembly. Instances of one product share their mesh.
struct Component {
  std::string name;  ///< Unique within the assembly.
  std::shared_ptr<const TriangleMesh>
      mesh;                           ///< In the component's own frame [mm]; cleaned (see clean_mesh); never null.
  RigidTransform assembly_from_mesh;  ///< Where the instance sits in the assembled state.
  Color color;
  std::uint32_t tree_node = 0;  ///< Its leaf in Assembly::tree.
  MeshFaults faults;            ///< Of the mesh, as it was read.
};

/// A node of the product tree; the root is node 0 and its own parent.
struct TreeNode {
  std::string name;
  std::uint32_t parent = 0;
};

/// A CAD assembly in its assembled state.
struct Assembly {
  std::string source_file;    ///< File name without its folder.
  std::string source_sha256;  ///< Of the file; for a folder of meshes, of its files one after another in load order.
  std::string source_units = "mm";  ///< As the file says, or as the user said.
  double deflection = 0;  ///< Linear tessellation deflection of the import [mm]; 0 where the input was meshes.
  double simplification_error = 0;  ///< The largest distance that a simplification moved the surface [mm].
  std::vector<TreeNode> tree;
  std::vector<Component> components;

  const Component& operator[](ComponentId id) const { return components[id.value]; }
  /// The component of that name, if there is one.
  std::optional<ComponentId> find(std::string_view name) const;
};

std::size_t triangle_count(const Assembly& assembly);

/// The component's vertices where they are in the assembled state [mm, assembly frame]: the numbers that every
/// collision method and every audit start from.
std::vector<Vec3> assembled_vertices(const Component& component);

/// The component's mesh with its assembled vertices.
TriangleMesh assembled_mesh(const Component& component);

/// The box around the assembled component.
Aabb assembled_bounds(const Component& component);
Aabb assembled_bounds(const Assembly& assembly);

/// The tolerance where the user gives none: the larger of 1e-5 of the diagonal and twice the deflection, plus twice
/// the simplification error [mm] (docs/guarantee.md).
double default_tolerance(const Assembly& assembly);

/// Makes the names unique: a repeat gets the suffix "#2", "#3", ... in order; an empty name becomes "unnamed".
void make_names_unique(std::vector<Component>& components);

}  // namespace dismantle
