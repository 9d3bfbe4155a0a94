// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"
#include "dismantle/math/vec3.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// An edge that is drawn as a line: a crease, a boundary edge, or a non-manifold edge.
struct FeatureEdge {
  std::uint32_t vertices[2] = {0, 0};  ///< Indices, ascending.
  std::uint32_t faces[2] = {0, 0};     ///< Two adjacent faces; equal at a boundary.
  friend bool operator==(const FeatureEdge&, const FeatureEdge&) = default;
};

/// A mesh prepared for rendering, shared by all instances and pictures.
struct RenderMesh {
  TriangleMesh mesh;                       ///< [mm]
  std::vector<Vec3f> corner_normals;       ///< Unit normals for smooth shading, shape [face_count][3].
  std::vector<FeatureEdge> feature_edges;  ///< Ordered by vertices.
};

/// Default crease angle [rad]: faces that meet at a smaller angle are shaded smoothly, others have a feature edge.
inline constexpr double kDefaultCreaseAngle = 0.6;

/// Computes corner normals and feature edges. A corner normal is the area-weighted mean over those faces around the
/// vertex whose normal is within the crease angle [rad] of the corner's own face.
RenderMesh make_render_mesh(TriangleMesh mesh, double crease_angle = kDefaultCreaseAngle);

}  // namespace dismantle
