// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/geometry/kdop.h"
#include "dismantle/narrowphase/ccd_triangle_triangle.h"
#include "dismantle/surface/assembly_triangles.h"

namespace dismantle {

/// The triangles of a step.
struct StepTriangles {
  Span<const Vec3> vertices_t0, vertices_t1;  ///< S_v(n), S_v(n+1) [mm]
  Span<const Face> faces;                     ///< In leaf order.

  DISMANTLE_HOST_DEVICE TriangleMotion motion(NodeIndex leaf) const {
    const Face face = faces[leaf];
    TriangleMotion m;
    for (int k = 0; k < 3; ++k) {
      m.t0[k] = vertices_t0[face.v[k]];
      m.t1[k] = vertices_t1[face.v[k]];
    }
    return m;
  }
  DISMANTLE_HOST_DEVICE Triangle end(NodeIndex leaf) const {
    const Face face = faces[leaf];
    return {{vertices_t1[face.v[0]], vertices_t1[face.v[1]], vertices_t1[face.v[2]]}};
  }
};

/// The triangles of a step at one time of it, with bounds that hold for the whole step; vertices go linearly.
struct MomentaryTriangles {
  const AssemblyTriangles* streams = nullptr;
  StepTriangles step;
  Span<const Kdop16> bounds;
  double s = 0;  ///< Time in the step, 0 to 1.

  Vec3 vertex(std::uint32_t v) const;
  Triangle triangle(NodeIndex leaf) const;
};

/// True where `point` lies inside the component's closed surface: a ray from it crosses the surface an odd number
/// of times. Rays that come too near to an edge to be counted are tried in another direction; a point for which all
/// directions are so counts as outside (it is on the surface, as near as rounding can tell). @pre the component is
/// closed
bool point_in_component(const MomentaryTriangles& now, Vec3 point, ComponentId component);

/// True where a point of the component's surface may be within `distance` [mm] of `point`; false is certain, up to
/// rounding relative to the coordinates.
bool surface_within(const MomentaryTriangles& now, Vec3 point, ComponentId component, double distance);

/// One vertex of each connected part of each component's surface: where surfaces do not meet, they say for their
/// whole part on which side of another surface it is. @return vertex indices in the streams' order
std::vector<std::uint32_t> shell_vertices(const AssemblyTriangles& streams, ComponentId component);

}  // namespace dismantle
