// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/audit_body.h"

namespace dismantle::audit {

/// True where two components are apart: all their triangles by more than `margin` [mm], and neither has a piece of its
/// surface inside the other where that is closed.
bool components_apart(const AuditBody& a, const AuditBody& b, const RigidTransform& a_from_b, double margin);

}  // namespace dismantle::audit
