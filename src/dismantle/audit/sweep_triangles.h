// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/audit_body.h"
#include "dismantle/audit/motion/motion_span.h"
#include "dismantle/audit/motion/relative_motion.h"

#include <cstdint>
#include <vector>

namespace dismantle::audit {

/// Two components, of which b moves against a.
struct PairSweep {
  const AuditBody* a = nullptr;
  const AuditBody* b = nullptr;
  double allowed = 0;                   ///< Penetration that is allowed [mm].
  double resolution = 0;                ///< Largest relative movement between samples that nothing certifies [mm].
  double rounding = 0;                  ///< How wrong a depth may be by rounding [mm].
  std::uint32_t first_active = 0;       ///< Segments before this one are not looked at: the pair is embedded there.
  std::vector<RelativeMotion> motions;  ///< One a segment of the move.
};

/// Where a rule was broken first.
struct Breach {
  std::uint32_t segment = 0;  ///< The first in which it was.
  double s = 0;               ///< When in that segment first, in [0, 1].
  double depth = 0;           ///< The deepest seen in that segment [mm]; 0: there is no breach.
  /// Takes in another breach; one in a later segment changes nothing.
  void add(std::uint32_t other_segment, double other_s, double other_depth);
  void add(const Breach& other);
};

/// A vertex that may cross the other component's surface, and when.
struct CrossingVertex {
  std::uint32_t vertex = 0;
  std::uint32_t segment = 0;
  double from = 0, to = 1;  ///< Of the segment: not before, and not after.
};

/// What the sweep of a pair found about its triangles.
struct TriangleFindings {
  Breach breach;
  double deepest = 0;                       ///< Deepest triangle pair at all samples [mm].
  std::size_t samples = 0;                  ///< Exact depths evaluated.
  std::vector<CrossingVertex> crossing[2];  ///< Of a against b, of b against a; only against closed components. By
                                            ///< vertex and segment, one for each.
};

/// Looks at every triangle pair of the sweep within the span, at every instant: rule 1 of the guarantee. Between
/// samples a certified axis holds, or the pair moves by at most the resolution; so no excursion beyond
/// allowed + resolution / 2 is missed, and none below allowed is reported. Looks no further than the segment with the
/// first breach.
TriangleFindings sweep_triangles(const PairSweep& pair, const std::vector<MotionSpan>& spans);

/// True where the components, b at `motion`'s start, have a gap wider than `margin` between all their triangles.
bool surfaces_apart(const AuditBody& a, const AuditBody& b, const RigidTransform& a_from_b, double margin);

}  // namespace dismantle::audit
