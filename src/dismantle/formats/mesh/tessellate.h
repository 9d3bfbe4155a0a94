// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"

namespace dismantle {

/// A closed mesh that approximates a primitive, with outward normals.
struct TessellatedShape {
  TriangleMesh mesh;      ///< Closed.
  double deflection = 0;  ///< Largest distance of its triangles from the exact surface, in the units of the shape.
};

/// A box centred at the origin with these edge lengths (exact).
TessellatedShape tessellate_box(Vec3 size);

/// A cylinder about the z axis, centred at the origin, with vertices on the surface.
TessellatedShape tessellate_cylinder(double radius, double length);

/// A cone about the z axis, its base of that radius at -length / 2 and its apex at length / 2.
TessellatedShape tessellate_cone(double radius, double length);

/// A sphere about the origin, with vertices on the surface.
TessellatedShape tessellate_sphere(double radius);

}  // namespace dismantle
