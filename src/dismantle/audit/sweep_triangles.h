// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/audit_body.h"
#include "dismantle/audit/motion/motion_span.h"
#include "dismantle/audit/motion/relative_motion.h"

#include <cstdint>
#include <vector>

namespace dismantle::audit {

/// The motion of a component b relative to a component a.
struct PairSweep {
  ///@{ The components; never null.
  const AuditBody* a = nullptr;
  const AuditBody* b = nullptr;
  ///@}
  double allowed = 0;                   ///< The allowance [mm].
  double resolution = 0;                ///< Largest relative movement between samples that no certificate covers [mm].
  double rounding = 0;                  ///< Error bound of a depth [mm].
  std::uint32_t first_active = 0;       ///< Segments before this one, in which the pair is embedded, are not checked.
  std::vector<RelativeMotion> motions;  ///< Of each segment of the move.
};

/// The first breach of a rule.
struct Breach {
  std::uint32_t segment = 0;  ///< The first segment with a breach.
  double s = 0;               ///< Time of the first breach in that segment, in [0, 1].
  double depth = 0;           ///< Largest depth in that segment [mm]; 0: there is no breach.
  ///@{ Merges another breach; one in a later segment changes nothing.
  void add(std::uint32_t other_segment, double other_s, double other_depth);
  void add(const Breach& other);
  ///@}
};

/// A vertex that may cross the other component's surface in a segment.
struct CrossingVertex {
  std::uint32_t vertex = 0;   ///< Index in its body.
  std::uint32_t segment = 0;  ///< Index of the segment.
  ///@{ It crosses neither before `from` nor after `to`, in [0, 1] of the segment.
  double from = 0, to = 1;
  ///@}
};

/// The findings of the triangle sweep of a pair.
struct TriangleFindings {
  Breach breach;            ///< Of rule 1.
  double deepest = 0;       ///< Largest depth of a triangle pair over all samples [mm].
  std::size_t samples = 0;  ///< Number of exact depths evaluated.
  /// Vertices of a against b, of b against a; only against closed components. One for each vertex and segment, in this
  /// order.
  std::vector<CrossingVertex> crossing[2];
};

/// Checks rule 1 of the guarantee for every triangle pair of the sweep during the span. Between samples an axis
/// certifies the depth, or the pair moves by at most the resolution: no depth above allowed + resolution / 2 is missed,
/// and none below allowed is reported. Ends after the segment with the first breach.
TriangleFindings sweep_triangles(const PairSweep& pair, const std::vector<MotionSpan>& spans);

/// True if all triangles of two components are further apart than `margin` [mm].
bool surfaces_apart(const AuditBody& a, const AuditBody& b, const RigidTransform& a_from_b, double margin);

}  // namespace dismantle::audit
