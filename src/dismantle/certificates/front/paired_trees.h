// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/certificate_kernels.h"

#include <cmath>

namespace dismantle {

/// What keeps things on their sides of each other that may be in each other by the allowance
/// (docs/design/0006-certificates.md, "Sides").
enum class SideRule {
  /// Closed solids: an axis that uses the allowance has to agree with the outward normals. Any that does may be taken,
  /// so the least blocking one is.
  Normals,
  /// Open sheets: the side on which they were when last apart is kept while they are in each other by the allowance. An
  /// axis may only be left for one within a right angle of it, or one that needs no allowance.
  Memory,
  /// Closed solids that overlap by design, where normals say little: any axis. Their other faces stop what one pair of
  /// faces lets through.
  Free,
};

/// An ObbTree's nodes, their cones and its triangles, wherever they are.
struct ObbTreeView {
  const ObbNode* nodes = nullptr;
  const NormalCone* cones = nullptr;
  const TriangleF* triangles = nullptr;
};

/// The gap of a certificate with A where `t` has it, up to LinearSweep::error [mm].
DISMANTLE_HOST_DEVICE inline float gap_at(const Certificate& c, const RigidTransformF& t) {
  const Vec3f w = c.axis.x * t.row[0] + c.axis.y * t.row[1] + c.axis.z * t.row[2];
  const NodeHull& h = c.hull;
  const float s0 = dot(w, h.span[0]), s1 = dot(w, h.span[1]), s2 = dot(w, h.span[2]);
  const float most = s0 > s1 ? s0 : s1;
  const float reach = h.kind > NodeHull::kBox ? (most > 0 ? most : 0) : std::fabs(s0) + std::fabs(s1) + std::fabs(s2);
  return c.offset - dot(c.axis, t.translation) - dot(w, h.center) - reach;
}

/// What a front asks of its two trees, and by which rules it takes the answers: the same text for the CPU and CUDA.
struct PairedTrees {
  ObbTreeView a, b;
  SideRule sides = SideRule::Memory;
  bool b_moves = false;  ///< Queries are of the moving node first.

  DISMANTLE_HOST_DEVICE BoxPairQuery box_query(std::uint32_t node_a, std::uint32_t node_b, Vec3f guard) const {
    const bool facing = sides == SideRule::Normals;
    const ObbTreeView &first = b_moves ? b : a, &second = b_moves ? a : b;
    const std::uint32_t moving = b_moves ? node_b : node_a, fixed = b_moves ? node_a : node_b;
    return {&first.nodes[moving], &second.nodes[fixed], guard, facing ? &first.cones[moving] : nullptr,
            facing ? &second.cones[fixed] : nullptr};
  }
  /// @pre both are leaves
  DISMANTLE_HOST_DEVICE TrianglePairQuery triangle_query(std::uint32_t node_a, std::uint32_t node_b,
                                                         Vec3f guard) const {
    const TriangleF *face_a = &a.triangles[a.nodes[node_a].child], *face_b = &b.triangles[b.nodes[node_b].child];
    return {b_moves ? face_b : face_a, b_moves ? face_a : face_b, guard, sides == SideRule::Normals};
  }
  DISMANTLE_HOST_DEVICE bool leaves(std::uint32_t node_a, std::uint32_t node_b) const {
    return a.nodes[node_a].leaf() && b.nodes[node_b].leaf();
  }
  /// Whether of two nodes A's is split: the one that takes more room.
  DISMANTLE_HOST_DEVICE bool splits_a(std::uint32_t node_a, std::uint32_t node_b) const {
    return a.nodes[node_a].size >= b.nodes[node_b].size;
  }

  /// The axis of a pair where it binds the pair to its side; zero otherwise.
  DISMANTLE_HOST_DEVICE Vec3f hint_of(const Certificate& c, const LinearSweep& sweep) const {
    const bool binds = sides == SideRule::Memory && c.offset > kNoCertificate && gap_at(c, sweep.t0) < sweep.error;
    return binds ? c.axis : Vec3f{};
  }
  /// The axis that the elementary test of two leaves begins with, after what was found of their triangles.
  DISMANTLE_HOST_DEVICE Vec3f leaf_hint(Vec3f hint, const NodeSeparation& found) const {
    return sides == SideRule::Memory ? hint : found.certificate.axis;
  }
  /// The least gap that certifies a pair. One that remembers no side gets it from an axis that needs no allowance.
  DISMANTLE_HOST_DEVICE float limit(Vec3f guard, const LinearSweep& sweep) const {
    return sides == SideRule::Memory && length_squared(guard) == 0 ? sweep.meeting : sweep.limit;
  }
  /// Whether two that are apart by so little may be in each other.
  DISMANTLE_HOST_DEVICE bool may_meet(const NodeSeparation& found, const LinearSweep& sweep) const {
    const bool on_edge = found.certificate.hull.kind == NodeHull::kTriangleOnEdge;
    return found.gap < sweep.meeting && (on_edge || sides != SideRule::Normals);
  }
  /// Whether what was found certifies a pair. Moving triangles may be apart although no one axis says so: that has to
  /// be found out once.
  /// @param on_edge it was found that they are in each other on edge
  DISMANTLE_HOST_DEVICE bool certifies(const NodeSeparation& found, Vec3f guard, bool on_edge,
                                       const LinearSweep& sweep) const {
    if (found.gap < limit(guard, sweep)) return false;
    return on_edge || found.certificate.hull.kind != NodeHull::kTriangleOnEdge || !may_meet(found, sweep);
  }
};

}  // namespace dismantle
