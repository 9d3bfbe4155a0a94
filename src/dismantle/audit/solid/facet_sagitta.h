// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/audit_body.h"
#include "dismantle/geometry/aabb.h"

namespace dismantle::audit {

/// How far the facets of a curved surface may lie inside it: the largest sagitta of a facet of a cylinder of the
/// surface's local radius, over the faces that touch a box [body frame of the assembled state, mm]. A facet whose
/// neighbour across an edge is inclined by an angle d of at most 30 degrees, and that is w wide across that edge, has
/// the sagitta w / 2 tan(d / 4). As one cylinder turns in another, the corners of the one meet the middles of the
/// other's facets: their overlap grows by up to both sagittas, by tessellation alone.
double facet_sagitta(const AuditBody& body, const Aabb& box);

}  // namespace dismantle::audit
