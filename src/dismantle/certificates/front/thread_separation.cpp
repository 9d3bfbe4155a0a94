// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/front/thread_separation.h"

#include "dismantle/math/angle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dismantle {

namespace {

/// No gap can be proved if the axes are further apart than this share of the period, or at a larger angle than this
/// [sine].
constexpr double kMaxOff = 0.25, kMaxSine = 0.02;
/// A segment between two points is taken to stay beyond this share of their distance from the axis.
constexpr double kKeptDistance = 0.75;
/// Bound of the rounding of a phase to float32, in periods.
constexpr double kPhaseRounding = 0x1p-23;
/// Nodes whose helix phases span more periods than this are not used.
constexpr double kMaxPeriods = 8;

ThreadMatch::Side side_of(const ThreadFrame& frame, const RevolutionSurface& shape, Vec3 origin) {
  return {frame.axis.point - origin, frame.axis.direction, frame.axis.first,
          ThreadBoundsList(frame, shape.vertices(), shape.faces(), shape.nodes())};
}

}  // namespace

std::vector<ThreadMatch> match_threads(const RevolutionSurface& a, Vec3 origin_a, const RevolutionSurface& b,
                                       Vec3 origin_b) {
  std::vector<ThreadMatch> matches;
  for (const ThreadAxis& x : a.threads())
    for (const ThreadAxis& y : b.threads()) {
      if (!threads_mate(x, y)) continue;
      // One frame for both: of two, the difference would count against every gap.
      const ThreadAxis& longer = better_known(x, y);
      ThreadFrame frame;
      frame.lead = longer.lead;
      frame.period = std::abs(longer.lead) / longer.starts;
      for (const ThreadAxis* thread : {&x, &y}) {
        // Helix phases change sign with the axis.
        const double sign = dot(thread->direction, x.direction) < 0 ? -1 : 1;
        for (const ThreadAxis::Flank& flank : thread->flanks)
          frame.add_direction({flank.normal.radial, sign * flank.normal.axial});
      }
      frame.axis =
          AxisFrame(longer.point, dot(longer.direction, x.direction) < 0 ? -longer.direction : longer.direction);
      matches.push_back({frame, {side_of(frame, a, origin_a), side_of(frame, b, origin_b)}});
    }
  return matches;
}

ThreadSweep::ThreadSweep(const ThreadMatch& match, int moving, const PairMotion& motion)
    : match_(&match), moving_(moving) {
  const ThreadMatch::Side &own = match.sides[moving], &other = match.sides[1 - moving];
  const Vec3 direction = motion.t0.rotation * own.direction, point = motion.t0 * own.point;
  tilt_ = direction - other.direction;
  const double along = dot(point - other.point, other.direction);
  const Vec3 at = other.point + along * other.direction;
  across_ = point - at;
  if (length(tilt_) > kMaxSine || length(across_) > kMaxOff * match.frame.period) return;

  // The direction of angle 0 of the moving side, turned back by the rotation that takes one axis to the other.
  const Vec3 swing = cross(other.direction, direction), first = motion.t0.rotation * own.first;
  const double cosine = dot(other.direction, direction);
  const Vec3 seen = first - cross(swing, first) + (1 / (1 + cosine)) * cross(swing, cross(swing, first));
  const Vec3 quarter = cross(other.direction, other.first);
  phase_ = along - match.frame.lead * std::atan2(dot(seen, quarter), dot(seen, other.first)) / kTurn;

  // The twist of the moving side in the fixed one's frame, from that of the fixed side in the moving one's frame.
  const Vec3 turning = -(motion.t0.rotation * (motion.back.angle * motion.back.axis));
  const Vec3 velocity =
      -(motion.t0.rotation * motion.back.velocity) + cross(turning, at - motion.t0 * motion.back.reference);
  const double angle = dot(turning, other.direction);
  turning_ = length(turning - angle * other.direction);
  sliding_ = length(velocity - (match.frame.lead * angle / kTurn) * other.direction);
  angle_ = length(turning);
  speed_ = length(velocity);
  useful_ = sliding_ < match.frame.period / 4;
  const ThreadBounds& whole = own.nodes.whole();
  largest_off_ = whole.begin <= whole.end ? off(whole) : std::numeric_limits<double>::infinity();
}

double ThreadSweep::off(const ThreadBounds& node) const {
  const double begin = node.begin, end = node.end, radius = node.max_radius;
  const double start =
      std::max(length(across_ + begin * tilt_), length(across_ + end * tilt_)) + length(tilt_) * radius;
  const double far = length(across_) + std::hypot(radius, std::max(std::abs(begin), std::abs(end)));
  return start + turning_ * (far + angle_ * far + speed_) + sliding_;
}

double ThreadSweep::phase() const {
  return nearest_remainder(phase_, match_->frame.period);
}

double ThreadSweep::kept_gap(float in_place, float phase) const {
  const double period = match_->frame.period;
  const double shifted =
      std::abs(nearest_remainder(phase_ - static_cast<double>(phase), period)) + kPhaseRounding * period;
  return static_cast<double>(in_place) - shifted - largest_off_;
}

ThreadSweep::Gap ThreadSweep::gap(std::uint32_t moving, std::uint32_t fixed) const {
  constexpr Gap kNone{-std::numeric_limits<double>::infinity(), 0};
  const ThreadFrame& frame = match_->frame;
  const ThreadBounds &m = match_->sides[moving_].nodes[moving], &f = match_->sides[1 - moving_].nodes[fixed];
  const double radius = std::min(m.min_radius, f.min_radius);
  const auto low = [&](const ThreadBounds& n, int k) { return static_cast<double>(n.low[k]); };
  const auto high = [&](const ThreadBounds& n, int k) { return static_cast<double>(n.high[k]); };
  const double max_phase_range = kMaxPeriods * frame.period;
  if (!(radius > 0) || !(high(m, 0) - low(m, 0) < max_phase_range) || !(high(f, 0) - low(f, 0) < max_phase_range))
    return kNone;
  const double off = this->off(m), slope = frame.lead / (kTurn * kKeptDistance * radius);
  const double steepest = std::sqrt(1 + slope * slope);  // no direction has a longer gradient
  const auto difference = [&](int k, double phase) {
    const double shift = frame.directions[k].axial * phase;
    return std::max(low(f, k) - high(m, k) - shift, low(m, k) + shift - high(f, k));
  };
  const double first = std::floor((low(m, 0) + phase_ - high(f, 0)) / frame.period);
  const double last = std::ceil((high(m, 0) + phase_ - low(f, 0)) / frame.period);
  const double beyond = static_cast<double>(std::max(f.min_radius - m.max_radius, m.min_radius - f.max_radius));
  // Other paths around the axis are longer still.
  double found = std::min(2 * (1 - kKeptDistance) * radius, frame.period / steepest);
  for (double turns = first; turns <= last; ++turns) {
    double widest = -std::numeric_limits<double>::infinity();
    for (int k = 0; k < frame.direction_count; ++k)
      widest = std::max(widest, difference(k, phase_ - turns * frame.period));
    found = std::min(found, std::max(beyond, widest / steepest));
    if (found <= off) return kNone;
  }
  return {found - off, found};
}

}  // namespace dismantle
