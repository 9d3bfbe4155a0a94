// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/formats/import/scene_assembly.h"
#include "dismantle/formats/mesh/tessellate.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace dismantle {

/// The fields of a Transform node.
struct VrmlTransform {
  std::array<double, 3> translation{};        ///< Applied last.
  std::array<double, 4> rotation{};           ///< Axis, and angle [rad].
  std::array<double, 3> scale{1, 1, 1};       ///< Along the axes that scale_orientation gives.
  std::array<double, 4> scale_orientation{};  ///< As rotation.
  std::array<double, 3> center{};             ///< Of rotation and scale.
};

/// The map of a Transform node. None if the length of an axis is not finite.
std::optional<SceneTransform> vrml_transform(const VrmlTransform& fields);

/// The fields of an IndexedFaceSet node.
struct VrmlPolygons {
  std::vector<Vec3> vertices;        ///< In the file's units.
  std::vector<double> indices;       ///< Of the corners; a negative one ends a polygon.
  bool is_counter_clockwise = true;  ///< Seen from outside.
};

/// The triangles of polygons. None if an index is out of range, or there are more than `triangle_limit`.
std::optional<TriangleMesh> vrml_mesh(VrmlPolygons polygons, std::size_t triangle_limit);

/// The mesh of a Box (of that size), Sphere, Cylinder or Cone node; axes along y.
TessellatedShape vrml_solid(std::string_view type, Vec3 size, double radius, double height);

/// The meshes as one, in the colour of the one with the largest surface.
SceneMesh joined(const std::vector<const SceneMesh*>& parts);

}  // namespace dismantle
