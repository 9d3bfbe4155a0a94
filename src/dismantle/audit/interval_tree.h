// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/sweep_triangles.h"

#include <cstdint>
#include <deque>
#include <vector>

namespace dismantle::audit {

/// A stretch of time in the sweep of a pair, and how far b gets in it: whole screws, or a part of one screw.
struct Interval {
  std::uint32_t span = 0;              ///< Of the span tree; a leaf of it, where it is a part of one screw.
  std::uint32_t first = 0, count = 0;  ///< Segments.
  double s = 0, duration = 1;          ///< Of one segment: when it starts, and how long it is.
  RigidTransform a_from_b;     ///< At its reference: at its start, or at the frame in the middle of several segments.
  Mat3 abs_rotation;           ///< |R|: half sizes of a box of b to half sizes in a's axes.
  Mat3 swept_a, swept_b;       ///< One segment: half sizes of a box of b to those of all that its points, seen from
                               ///< the centre's linear path, cover, in a's axes and in b's axes at the reference.
  Mat3 b_from_a;               ///< The reference's rotation.
  RelativeMotion motion;       ///< One segment: from the start of the interval to its end.
  double shift = 0, turn = 0;  ///< Several segments: as in MotionSpan.
  std::uint32_t halves[2] = {0, 0};  ///< 0 where it is not split yet.

  bool one_segment() const { return count == 1; }
  /// How far a point of a box of b gets from where it is at the reference [mm].
  double reach(const BoxNode& b) const;
  /// A lower bound of the distance of the two boxes at every instant of the interval.
  double clearance(const BoxNode& a, const BoxNode& b) const;
};

/// The interval of one whole motion.
Interval interval_of(const RelativeMotion& motion);

/// The span tree of a sweep, and below its leaves every screw in halves, quarters, and so on. Made as it is asked for.
class IntervalTree {
 public:
  /// A screw is halved this often at most.
  static constexpr int kMaxHalvings = 6;

  /// @param spans as motion_spans makes them; both must outlive the tree
  IntervalTree(const PairSweep& pair, const std::vector<MotionSpan>& spans);

  /// The root is 0. References stay valid.
  const Interval& operator[](std::uint32_t i) const { return intervals_[i]; }
  /// True where halves(i) may be asked for.
  bool can_split(std::uint32_t i) const;
  /// The earlier and the later half of interval i. @pre can_split(i)
  const std::uint32_t (&halves(std::uint32_t i))[2];

 private:
  std::uint32_t add_span(std::uint32_t span);
  std::uint32_t add_part(std::uint32_t span, double s, double duration);

  const PairSweep& pair_;
  const std::vector<MotionSpan>& spans_;
  std::deque<Interval> intervals_;
};

}  // namespace dismantle::audit
