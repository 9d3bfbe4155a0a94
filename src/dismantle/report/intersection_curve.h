// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"

#include <vector>

namespace dismantle {

/// A segment of the intersection curve of two surfaces.
struct CurveSegment {
  Vec3 ends[2];  ///< [mm]
};

/// The intersection curve of two meshes, one segment per triangle pair, for display: computed in plain floating point,
/// without coplanar contact. Ordered by the faces of `a`, then of `b`.
std::vector<CurveSegment> intersection_curve(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace dismantle
