// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/formats/import/mesh_source.h"
#include "dismantle/formats/import/scene_assembly.h"

#include <cstddef>
#include <string_view>
#include <vector>

namespace dismantle {

/// The shapes of a VRML file and the groups that place them. A scene's mesh is an index into `meshes`.
struct VrmlScene {
  Scene scene;  ///< Nodes are named by DEF, or after what is around them. No node is its own ancestor.
  std::vector<SceneMesh> meshes;  ///< Of all shapes.
  double deflection = 0;          ///< Largest distance of a triangle from the sphere, cylinder or cone that it is of.
};

/// Parses VRML 2.0 (VRML97): groups, transforms, shapes of polygons, boxes, spheres, cylinders and cones, and their
/// diffuse colours; DEF and USE. Lines, points, lights, sounds and scripts are left out. Errors: Unreadable if the
/// grammar is broken, an index is out of range or a number not finite, for shapes by PROTO, Inline, Extrusion or
/// ElevationGrid, and if there are more than `triangle_limit` triangles.
Result<VrmlScene> parse_vrml(const MeshSource& source, std::size_t triangle_limit);

}  // namespace dismantle
