// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"
#include "dismantle/math/vec3.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// An edge that is drawn as a line: a crease, the border of an open mesh, or one with more than two triangles.
struct FeatureEdge {
  std::uint32_t vertices[2] = {0, 0};
  std::uint32_t faces[2] = {0, 0};  ///< Two of its triangles; equal at a border.
  friend bool operator==(const FeatureEdge&, const FeatureEdge&) = default;
};

/// A mesh made ready for pictures: prepared once, shared by all instances and all pictures.
struct RenderMesh {
  TriangleMesh mesh;                       ///< [mm]
  std::vector<Vec3f> corner_normals;       ///< Unit normals for smooth shading, shape [face_count][3].
  std::vector<FeatureEdge> feature_edges;  ///< Ordered by their vertices.
};

/// Neighbouring triangles that meet at less than this angle [rad] are shaded as one smooth surface; at more, the edge
/// is a feature.
inline constexpr double kDefaultCreaseAngle = 0.6;

/// Normals and feature edges of a mesh. A corner's normal is the area-weighted mean of the triangles around its vertex
/// that are within the crease angle of the corner's own triangle.
RenderMesh make_render_mesh(TriangleMesh mesh, double crease_angle = kDefaultCreaseAngle);

}  // namespace dismantle
