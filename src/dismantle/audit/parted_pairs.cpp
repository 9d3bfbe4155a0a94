// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/parted_pairs.h"

#include "dismantle/audit/sweep_triangles.h"

namespace dismantle::audit {

namespace {

bool any_piece_inside(const AuditBody& pieces, const AuditBody& solid, const RigidTransform& solid_from_pieces) {
  if (!solid.closed() || solid.empty()) return false;
  for (const std::uint32_t v : pieces.piece_vertices())
    if (solid.contains(solid_from_pieces * pieces.vertex(v))) return true;
  return false;
}

}  // namespace

bool components_apart(const AuditBody& a, const AuditBody& b, const RigidTransform& a_from_b, double margin) {
  return surfaces_apart(a, b, a_from_b, margin) && !any_piece_inside(b, a, a_from_b) &&
         !any_piece_inside(a, b, inverse(a_from_b));
}

}  // namespace dismantle::audit
