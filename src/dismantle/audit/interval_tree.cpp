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

}  // namespace

double Interval::reach(const BoxNode& b) const {
  if (!one_segment()) return shift + turn * b.reach;
  return length(motion.velocity(a_from_b * b.center)) + motion.screw.angle * b.radius;
}

BoxInInterval::BoxInInterval(const Interval& interval, const BoxNode& box, bool of_b)
    : interval_(interval), box_(box), of_b_(of_b) {
  if (of_b) {
    along_a_ = along_a(box);
    along_b_ = along_b(along_a_, box);
    deviation_ = deviation(along_a_, box);
  } else {
    half_in_b_ = transposed(interval.abs_rotation) * box.half;
  }
}

BoxInInterval::Swept BoxInInterval::along_a(const BoxNode& of_b) const {
  const Vec3 center = interval_.a_from_b * of_b.center;
  if (!interval_.one_segment()) return {center, {}, interval_.abs_rotation * of_b.half};
  return {center, interval_.motion.velocity(center), interval_.swept_a * of_b.half};
}

BoxInInterval::Swept BoxInInterval::along_b(const Swept& along_a, const BoxNode& of_b) const {
  const Vec3 center = interval_.b_from_a * along_a.center;
  if (!interval_.one_segment()) return {center, {}, of_b.half};
  return {center, interval_.b_from_a * along_a.velocity, interval_.swept_b * of_b.half};
}

/// Bound of the distance of the points of a box of b from their linear paths, or from where they are at the reference.
double BoxInInterval::deviation(const Swept& along_a, const BoxNode& of_b) const {
  if (!interval_.one_segment()) return interval_.reach(of_b);
  const double angle = interval_.motion.screw.angle;
  // The velocity has constant magnitude and turns about the axis.
  return 0.5 * (interval_.motion.acceleration(along_a.velocity) + angle * angle * of_b.radius);
}

bool BoxInInterval::is_clear_of(const BoxNode& other, double distance) const {
  const BoxNode& a = of_b_ ? other : box_;
  const Swept in_a = of_b_ ? along_a_ : along_a(other);
  const auto is_clear = [&](Vec3 offset, const Swept& swept, Vec3 half) {
    const Vec3 gap = max(nearest_to_zero(offset, offset + swept.velocity) - (half + swept.half), Vec3{});
    const double squared = dot(gap, gap);
    if (squared <= distance * distance) return false;
    const double least = distance + (of_b_ ? deviation_ : deviation(in_a, other));
    return squared > least * least;
  };
  if (is_clear(in_a.center - a.center, in_a, a.half)) return true;
  const Swept in_b = of_b_ ? along_b_ : along_b(in_a, other);
  const Vec3 half_in_b = of_b_ ? transposed(interval_.abs_rotation) * a.half : half_in_b_;
  return is_clear(in_b.center - interval_.b_from_a * a.center, in_b, half_in_b);
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
