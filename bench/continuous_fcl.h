// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"
#include "dismantle/math/rigid_transform.h"

namespace dismantle {

/// The two ways in which FCL tests moving meshes.
enum class FclSolver { Naive, ConservativeAdvancement };

/// What a continuous test says of one motion.
struct FirstTouch {
  bool free = true;
  double toi = 1;  ///< As a part of the motion; 1 where free.
};

/// FCL's continuous test of two meshes (continuousCollide() over trees of OBBRSS boxes, a screw motion, times to 1e-4):
/// one stands at the identity, the other goes from `start` to `end`. The naive one looks at ten poses, as is FCL's
/// default.
FirstTouch continuous_fcl(const TriangleMesh& fixed, const TriangleMesh& moving, const Pose& start, const Pose& end,
                          FclSolver solver);

}  // namespace dismantle
