// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/audit_body.h"

namespace dismantle::audit {

/// True if two components are apart: all their triangles by more than `margin` [mm], and no connected piece of a
/// surface is inside the other component where that is closed.
bool components_apart(const AuditBody& a, const AuditBody& b, const RigidTransform& a_from_b, double margin);

}  // namespace dismantle::audit
