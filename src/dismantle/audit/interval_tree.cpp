// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/interval_tree.h"

#include "dismantle/core/contract.h"

#include <algorithm>
#include <cmath>

namespace dismantle::audit {

namespace {

Mat3 absolute(const Mat3& m) {
  Mat3 result;
  for (int i = 0; i < 3; ++i) result.row[i] = max(m.row[i], -m.row[i]);
  return result;
}

Mat3 sum(const Mat3& m, const Mat3& n) {
  return {{m.row[0] + n.row[0], m.row[1] + n.row[1], m.row[2] + n.row[2]}};
}

/// The matrix of v -> w x v.
Mat3 cross_matrix(Vec3 w) {
  return {{{0, -w.z, w.y}, {w.z, 0, -w.x}, {-w.y, w.x, 0}}};
}

/// The smallest absolute value of each coordinate on the segment between two points.
Vec3 nearest_to_zero(Vec3 from, Vec3 to) {
  return max(max(min(from, to), -max(from, to)), Vec3{});
}

/// The first `part` of a screw motion; a later part of the same length has the same twist.
Screw scaled(const Screw& screw, double part) {
  Screw result = screw;
  result.velocity = part * screw.velocity;
  result.angle = part * screw.angle;
  return result;
}

double length_of_positive(Vec3 v) {
  return length(max(v, Vec3{}));
}

}  // namespace

double Interval::reach(const BoxNode& b) const {
  if (!one_segment()) return shift + turn * b.reach;
  return length(motion.velocity(a_from_b * b.center)) + motion.screw.angle * b.radius;
}

double Interval::clearance(const BoxNode& a, const BoxNode& b) const {
  const Vec3 center = a_from_b * b.center;
  const Vec3 offset = center - a.center;
  if (!one_segment()) {
    const double in_a = length_of_positive(max(offset, -offset) - (a.half + abs_rotation * b.half));
    const Vec3 offset_b = b_from_a * offset;
    const double in_b = length_of_positive(max(offset_b, -offset_b) - (b.half + transposed(abs_rotation) * a.half));
    return std::max(in_a, in_b) - reach(b);
  }
  const Vec3 velocity = motion.velocity(center);
  // Bound of a path's deviation from its tangent: the velocity has constant magnitude and turns about the axis.
  const double deviation = 0.5 * (motion.acceleration(velocity) + motion.screw.angle * motion.screw.angle * b.radius);
  const Vec3 near_a = nearest_to_zero(offset, offset + velocity);
  const double in_a = length_of_positive(near_a - (a.half + swept_a * b.half));
  if (in_a > deviation) return in_a - deviation;
  const Vec3 near_b = nearest_to_zero(b_from_a * offset, b_from_a * (offset + velocity));
  const double in_b = length_of_positive(near_b - (swept_b * b.half + transposed(abs_rotation) * a.half));
  return std::max(in_a, in_b) - deviation;
}

Interval interval_of(const RelativeMotion& motion) {
  Interval interval;
  interval.count = 1;
  interval.motion = motion;
  interval.a_from_b = motion.start;
  const Mat3& rotation = motion.start.rotation;
  interval.abs_rotation = absolute(rotation);
  interval.b_from_a = transposed(rotation);
  const Mat3 turning = cross_matrix(motion.screw.angle * motion.screw.axis) * rotation;
  interval.swept_a = sum(interval.abs_rotation, absolute(turning));
  interval.swept_b = sum(Mat3{}, absolute(interval.b_from_a * turning));
  return interval;
}

IntervalTree::IntervalTree(const PairMotion& pair, const std::vector<MotionSpan>& spans) : pair_(pair), spans_(spans) {
  add_span(0);
}

bool IntervalTree::can_split(std::uint32_t i) const {
  return !intervals_[i].one_segment() || intervals_[i].duration > std::ldexp(1.0, -kMaxHalvings);
}

const std::uint32_t (&IntervalTree::halves(std::uint32_t i))[2] {
  DISMANTLE_EXPECT(can_split(i));
  Interval& interval = intervals_[i];
  if (interval.halves[0] != 0) return interval.halves;
  if (interval.one_segment()) {
    const double half = interval.duration / 2;
    interval.halves[0] = add_part(interval.span, interval.s, half);
    interval.halves[1] = add_part(interval.span, interval.s + half, half);
  } else {
    interval.halves[0] = add_span(interval.span + 1);
    interval.halves[1] = add_span(spans_[interval.span].right);
  }
  return interval.halves;
}

std::uint32_t IntervalTree::add_span(std::uint32_t span) {
  const MotionSpan& from = spans_[span];
  if (from.count == 1) return add_part(span, 0, 1);
  Interval interval;
  interval.span = span;
  interval.first = from.first;
  interval.count = from.count;
  interval.a_from_b = pair_.motions[from.middle].start;
  interval.abs_rotation = absolute(interval.a_from_b.rotation);
  interval.b_from_a = transposed(interval.a_from_b.rotation);
  interval.shift = from.shift;
  interval.turn = from.turn;
  intervals_.push_back(interval);
  return static_cast<std::uint32_t>(intervals_.size() - 1);
}

std::uint32_t IntervalTree::add_part(std::uint32_t span, double s, double duration) {
  const RelativeMotion& whole = pair_.motions[spans_[span].first];
  Interval interval = interval_of({whole.at(s), scaled(whole.screw, duration)});
  interval.span = span;
  interval.first = spans_[span].first;
  interval.s = s;
  interval.duration = duration;
  intervals_.push_back(interval);
  return static_cast<std::uint32_t>(intervals_.size() - 1);
}

}  // namespace dismantle::audit
