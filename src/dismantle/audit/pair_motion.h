// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/audit_body.h"
#include "dismantle/audit/motion/relative_motion.h"

#include <vector>

namespace dismantle::audit {

/// The motion of a component b relative to a component a through the segments of a move.
struct PairMotion {
  ///@{ The surfaces of the components; never null.
  const AuditBody* a = nullptr;
  const AuditBody* b = nullptr;
  ///@}
  double rounding = 0;                  ///< Error bound of a depth [mm].
  std::vector<RelativeMotion> motions;  ///< Of each segment of the move.
};

/// True if all triangles of two components are further apart than `margin` [mm].
bool surfaces_apart(const AuditBody& a, const AuditBody& b, const RigidTransform& a_from_b, double margin);

}  // namespace dismantle::audit
