// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/motion/motion_span.h"
#include "dismantle/audit/pair_motion.h"

#include <cstdint>
#include <deque>
#include <vector>

namespace dismantle::audit {

/// A time interval in the sweep of a pair with bounds of b's motion: several whole segments, or a part of one.
struct Interval {
  std::uint32_t span = 0;  ///< Node of the span tree; a leaf for a part of one segment.
  ///@{ Segments [first, first + count).
  std::uint32_t first = 0, count = 0;
  ///@}
  ///@{ Of one segment: begin and length, as parts of the segment.
  double s = 0, duration = 1;
  ///@}
  RigidTransform a_from_b;  ///< Reference pose of b: at the begin, or at the middle frame of several segments.
  Mat3 abs_rotation;        ///< |R|: maps half sizes of a box of b to half sizes along a's axes.
  ///@{ Of one segment: map half sizes of a box of b to those of the region that its points cover relative to the linear
  /// path of the box's centre, along the axes of a and along those of b at the reference.
  Mat3 swept_a, swept_b;
  ///@}
  Mat3 b_from_a;          ///< Rotation of the reference pose.
  RelativeMotion motion;  ///< Of one segment: from the begin of the interval to its end.
  ///@{ Of several segments: as in MotionSpan.
  double shift = 0, turn = 0;
  ///@}
  std::uint32_t halves[2] = {0, 0};  ///< Indices of the two halves; 0 where it is not split yet.

  /// True for a part of one segment.
  bool one_segment() const { return count == 1; }
  /// Bound of the distance of a point of a box of b from its position at the reference [mm].
  double reach(const BoxNode& b) const;
};

/// A box of one of the two bodies during an interval, for comparisons with many boxes of the other body.
class BoxInInterval {
 public:
  /// @param interval, box must outlive this @param of_b the box is one of b, otherwise of a
  BoxInInterval(const Interval& interval, const BoxNode& box, bool of_b);

  /// True if a box of the other body is certainly further away than `distance` throughout the interval.
  /// @param distance not negative [mm]
  bool is_clear_of(const BoxNode& other, double distance) const;

 private:
  /// The region that the points of a box of b cover relative to the linear path of its centre, along some axes.
  struct Swept {
    Vec3 center, velocity;  // of the box's centre
    Vec3 half;              // half sizes of the region
  };
  Swept along_a(const BoxNode& of_b) const;
  Swept along_b(const Swept& along_a, const BoxNode& of_b) const;
  double deviation(const Swept& along_a, const BoxNode& of_b) const;

  const Interval& interval_;
  const BoxNode& box_;
  bool of_b_;
  Swept along_a_, along_b_;  // of a box of b
  double deviation_ = 0;     // likewise
  Vec3 half_in_b_;           // of a box of a
};

/// The interval of one whole motion.
Interval interval_of(const RelativeMotion& motion);

/// The span tree of a sweep, and below its leaves every segment in halves, quarters, and so on. Nodes are created on
/// demand.
class IntervalTree {
 public:
  /// Largest number of times that a segment is halved.
  static constexpr int kMaxHalvings = 6;

  /// @param spans of motion_spans(); both must outlive the tree
  IntervalTree(const PairMotion& pair, const std::vector<MotionSpan>& spans);

  /// An interval; 0 is the root. References remain valid.
  const Interval& operator[](std::uint32_t i) const { return intervals_[i]; }
  /// True if interval i can be split by halves().
  bool can_split(std::uint32_t i) const;
  /// The earlier and the later half of interval i. @pre can_split(i)
  const std::uint32_t (&halves(std::uint32_t i))[2];

 private:
  std::uint32_t add_span(std::uint32_t span);
  std::uint32_t add_part(std::uint32_t span, double s, double duration);

  const PairMotion& pair_;
  const std::vector<MotionSpan>& spans_;
  std::deque<Interval> intervals_;
};

}  // namespace dismantle::audit
