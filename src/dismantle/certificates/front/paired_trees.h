// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/certificate_kernels.h"

#include <cmath>

namespace dismantle {

/// The rule that keeps pairs that overlap within the allowance from changing sides (docs/design/0006-certificates.md,
/// "Sides").
enum class SideRule {
  /// Closed solids: an axis that uses the allowance has to agree with the outward normals. Any such axis may be used,
  /// so the least blocking one is.
  Normals,
  /// Open sheets: while they overlap within the allowance they keep the side on which they were last apart. An axis may
  /// only be replaced by one within a right angle of it, or by one that needs no allowance.
  Memory,
  /// Closed solids that overlap by design, where normals say little: any axis. Motions that one pair of faces lets
  /// through are stopped by their other faces.
  Free,
};

/// View of an ObbTree in the memory of the host or of a device.
struct ObbTreeView {
  const ObbNode* nodes = nullptr;        ///< As ObbTree::nodes.
  const NormalCone* cones = nullptr;     ///< As ObbTree::cones.
  const TriangleF* triangles = nullptr;  ///< As ObbTree::triangles.
};

/// The gap of a certificate with A at pose `t`, up to LinearSweep::error [mm].
DISMANTLE_HOST_DEVICE inline float gap_at(const Certificate& c, const RigidTransformF& t) {
  const Vec3f w = c.axis.x * t.row[0] + c.axis.y * t.row[1] + c.axis.z * t.row[2];
  const NodeHull& h = c.hull;
  const float s0 = dot(w, h.span[0]), s1 = dot(w, h.span[1]), s2 = dot(w, h.span[2]);
  const float larger = s0 > s1 ? s0 : s1;
  const float reach =
      h.kind > NodeHull::kBox ? (larger > 0 ? larger : 0) : std::fabs(s0) + std::fabs(s1) + std::fabs(s2);
  return c.offset - dot(c.axis, t.translation) - dot(w, h.center) - reach;
}

/// The two trees of a front and its rules: makes the queries for the kernels and decides on their results. The same
/// code on the CPU and on CUDA.
struct PairedTrees {
  ObbTreeView a;                      ///< Tree of component A.
  ObbTreeView b;                      ///< Tree of component B.
  SideRule sides = SideRule::Memory;  ///< How the pair keeps its sides.
  bool b_moves = false;               ///< B is the moving component. Queries name the moving node first.

  /// The query for the boxes of two nodes. @param guard as BoxPairQuery::guard
  DISMANTLE_HOST_DEVICE BoxPairQuery box_query(std::uint32_t node_a, std::uint32_t node_b, Vec3f guard) const {
    const bool facing = sides == SideRule::Normals;
    const ObbTreeView &first = b_moves ? b : a, &second = b_moves ? a : b;
    const std::uint32_t moving = b_moves ? node_b : node_a, fixed = b_moves ? node_a : node_b;
    return {&first.nodes[moving], &second.nodes[fixed], guard, facing ? &first.cones[moving] : nullptr,
            facing ? &second.cones[fixed] : nullptr};
  }
  /// The query for the triangles of two leaves. @param guard as BoxPairQuery::guard @pre both nodes are leaves
  DISMANTLE_HOST_DEVICE TrianglePairQuery triangle_query(std::uint32_t node_a, std::uint32_t node_b,
                                                         Vec3f guard) const {
    const TriangleF *face_a = &a.triangles[a.nodes[node_a].child], *face_b = &b.triangles[b.nodes[node_b].child];
    return {b_moves ? face_b : face_a, b_moves ? face_a : face_b, guard, sides == SideRule::Normals};
  }
  /// True if both nodes are leaves.
  DISMANTLE_HOST_DEVICE bool both_leaves(std::uint32_t node_a, std::uint32_t node_b) const {
    return a.nodes[node_a].leaf() && b.nodes[node_b].leaf();
  }
  /// True if the node of A is to be split rather than that of B: the larger one is.
  DISMANTLE_HOST_DEVICE bool splits_a(std::uint32_t node_a, std::uint32_t node_b) const {
    return a.nodes[node_a].size >= b.nodes[node_b].size;
  }

  /// The axis of a pair's certificate if it binds the pair to its side; else zero.
  DISMANTLE_HOST_DEVICE Vec3f hint_of(const Certificate& c, const LinearSweep& sweep) const {
    const bool binds = sides == SideRule::Memory && c.offset > kNoCertificate && gap_at(c, sweep.t0) < sweep.error;
    return binds ? c.axis : Vec3f{};
  }
  /// The axis that the triangle-pair test of two leaves starts with.
  /// @param found the separation of their triangles
  DISMANTLE_HOST_DEVICE Vec3f triangle_hint(Vec3f hint, const NodeSeparation& found) const {
    return sides == SideRule::Memory ? hint : found.certificate.axis;
  }
  /// The smallest gap that certifies a pair. A pair that remembers no side needs an axis that uses no allowance.
  DISMANTLE_HOST_DEVICE float limit(Vec3f guard, const LinearSweep& sweep) const {
    return sides == SideRule::Memory && length_squared(guard) == 0 ? sweep.meeting : sweep.limit;
  }
  /// True if a pair with this separation may overlap.
  DISMANTLE_HOST_DEVICE bool may_overlap(const NodeSeparation& found, const LinearSweep& sweep) const {
    const bool on_edge = found.certificate.hull.kind == NodeHull::kTriangleOnEdge;
    return found.gap < sweep.meeting && (on_edge || sides != SideRule::Normals);
  }
  /// True if a separation certifies a pair. Moving triangles may be apart although no single axis separates them: the
  /// triangle-pair test has to decide that once.
  /// @param on_edge a test has found that the two overlap on edge
  DISMANTLE_HOST_DEVICE bool certifies(const NodeSeparation& found, Vec3f guard, bool on_edge,
                                       const LinearSweep& sweep) const {
    if (found.gap < limit(guard, sweep)) return false;
    return on_edge || found.certificate.hull.kind != NodeHull::kTriangleOnEdge || !may_overlap(found, sweep);
  }
};

}  // namespace dismantle
