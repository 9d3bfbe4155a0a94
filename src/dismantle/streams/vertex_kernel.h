// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/math/rigid_transform.h"

namespace dismantle {

/// S_v0, S_tm -> S_v(n+1) for the vertices of one component (Du et al. 2015, section 4.2). Item: a vertex of the range.
struct VertexUpdateKernel {
  RigidTransform transform;    ///< World from assembled.
  Span<const Vec3> assembled;  ///< S_v0 [mm, assembled].
  Span<Vec3> moved;            ///< Output: S_v(n+1) [mm, world].

  /// Transforms vertex i.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const { moved[i] = transform * assembled[i]; }
};

}  // namespace dismantle
