// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/geometry/kdop.h"
#include "dismantle/narrowphase/ccd_triangle_triangle.h"
#include "dismantle/surface/assembly_triangles.h"

namespace dismantle {

/// The triangles of a step, whose vertices move linearly.
struct StepTriangles {
  Span<const Vec3> vertices_t0;  ///< S_v(n): positions at the beginning [mm].
  Span<const Vec3> vertices_t1;  ///< S_v(n+1): positions at the end [mm].
  Span<const Face> faces;        ///< In leaf order.

  /// The triangle of a leaf during the step.
  DISMANTLE_HOST_DEVICE TriangleMotion motion(NodeIndex leaf) const {
    const Face face = faces[leaf];
    TriangleMotion m;
    for (int k = 0; k < 3; ++k) {
      m.t0[k] = vertices_t0[face.v[k]];
      m.t1[k] = vertices_t1[face.v[k]];
    }
    return m;
  }
  /// The triangle of a leaf at the end of the step.
  DISMANTLE_HOST_DEVICE Triangle end(NodeIndex leaf) const {
    const Face face = faces[leaf];
    return {{vertices_t1[face.v[0]], vertices_t1[face.v[1]], vertices_t1[face.v[2]]}};
  }
};

/// The triangles of a step at one time of it.
struct MomentaryTriangles {
  const AssemblyTriangles* triangles = nullptr;  ///< Their BVH; never null.
  StepTriangles step;                            ///< Their motion.
  Span<const Kdop16> bounds;                     ///< Of each node of the BVH, valid for the whole step.
  double s = 0;                                  ///< Time in the step, 0 to 1.

  /// Position of a vertex at the time `s` [mm].
  Vec3 vertex(std::uint32_t v) const;
  /// Triangle of a leaf at the time `s`.
  Triangle triangle(NodeIndex leaf) const;
};

/// True if `point` lies inside the component's closed surface, by inside_by_rays(). A point on the surface, as near as
/// rounding can tell, counts as outside. @pre the component is closed
bool point_in_component(const MomentaryTriangles& now, Vec3 point, ComponentId component);

/// True if a point of the component's surface may be within `distance` [mm] of `point`; false is certain, up to
/// rounding relative to the coordinates.
bool surface_within(const MomentaryTriangles& now, Vec3 point, ComponentId component, double distance);

}  // namespace dismantle
