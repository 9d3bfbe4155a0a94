// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"

namespace dismantle {

/// A closed mesh that stands for a round body, normals out, and the largest distance of its triangles from the body.
struct TessellatedShape {
  TriangleMesh mesh;
  double deflection = 0;
};

/// A box about the origin with these edge lengths (exact).
TessellatedShape tessellate_box(Vec3 size);

/// A cylinder about the z axis, the origin in its middle, with corners on the surface.
TessellatedShape tessellate_cylinder(double radius, double length);

/// A sphere about the origin, with corners on the surface.
TessellatedShape tessellate_sphere(double radius);

}  // namespace dismantle
