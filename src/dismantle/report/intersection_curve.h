// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"

#include <vector>

namespace dismantle {

/// A piece of the curve along which two surfaces cut each other.
struct CurveSegment {
  Vec3 ends[2];  ///< [mm]
};

/// Where the surfaces of two meshes cut each other, a segment a triangle pair, for pictures: in plain floating point,
/// and without what lies in a common plane. Ordered by the faces of `a`, then of `b`.
std::vector<CurveSegment> intersection_curve(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace dismantle
