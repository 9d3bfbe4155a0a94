// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/front/radial_separation.h"

#include "dismantle/math/vec3f.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dismantle {

namespace {

/// A sweep uses at most this many pairs of axes, the nearest at its start.
constexpr std::size_t kMaxPairs = 3;
/// Axes are near each other where the sine of the angle between them is at most this,
constexpr double kMaxSine = 0.1;
/// and the distance of one's point from the other is at most this share of the smaller component's size,
constexpr double kMaxOff = 0.05;
/// and no larger than the room between the cylinders about the one and the other, or than this share of that size.
constexpr double kOffWithoutRoom = 0.002;
/// Bound of the rounding of positions along axes [mm].
constexpr double kPositionRounding = 1e-6;
/// Gaps are bounded above by this share of the outer surface's radius.
constexpr double kPastEnds = 0.1;

/// An axis in some frame.
struct Line {
  Vec3 point, direction;
};

Line line_of(const RevolutionAxis& axis, Vec3 origin) {
  return {axis.point - origin, axis.direction};
}
Line moved(const RigidTransform& t, const Line& line) {
  return {t * line.point, t.rotation * line.direction};
}
Vec3 across(Vec3 v, Vec3 direction) {
  return v - dot(v, direction) * direction;
}

}  // namespace

std::pair<double, double> RadialSweep::Off::part_beside(const RadialBounds& inner, const RadialBounds& outer,
                                                        double past) const {
  const double aside = max_aside * static_cast<double>(inner.max_radius) + kPositionRounding + past;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int end = 0; end < 2; ++end)
    for (const double border : {static_cast<double>(outer.begin) - aside, static_cast<double>(outer.end) + aside}) {
      const double position = (border - beside[end]) / ahead[end];
      low = std::min(low, position);
      high = std::max(high, position);
    }
  const double begin = inner.begin, end = inner.end;
  return {std::clamp(low, begin, end), std::clamp(high, begin, end)};
}

double RadialSweep::Off::upper_bound(const RadialBounds& inner, const RadialBounds& outer, double room) const {
  const double beside_each_other = toward(inner, outer, 0);
  if (room <= beside_each_other) return beside_each_other;
  // They are apart, but past the ends they may be nearer.
  const double past = kPastEnds * static_cast<double>(outer.min_radius);
  return std::max(room - past, std::min(room, toward(inner, outer, past)));
}

double RadialSweep::Off::toward(const RadialBounds& inner, const RadialBounds& outer, double past) const {
  const Vec3 middle = to_double(outer.toward);
  const double cosine = outer.cosine, sine = outer.sine;
  const auto [begin, stop] = part_beside(inner, outer, past);
  double largest = -std::numeric_limits<double>::infinity();  // convex along the axis
  for (int end = 0; end < 2; ++end)
    for (const double position : {begin, stop}) {
      const Vec3 off = at[end] + position * along[end];
      const double size = length(off), along_middle = dot(off, middle);
      // Its smallest angle to a direction of the sector is its angle to the middle less half the sector.
      const double across_it = std::sqrt(std::max(0.0, size * size - along_middle * along_middle));
      largest = std::max(largest, along_middle >= cosine * size ? size : along_middle * cosine + across_it * sine);
    }
  return largest;
}

std::optional<CylinderFit> RadialSweep::fit(std::uint32_t moving, std::uint32_t fixed, double max_deviation) const {
  const RadialBounds &m = (*moving_)[moving], &f = (*fixed_)[fixed];
  const bool moving_inside = m.clear_out && f.clear_in, fixed_inside = f.clear_out && m.clear_in;
  const double together = static_cast<double>(m.radial_deviation) + static_cast<double>(f.radial_deviation);
  if (moving_inside == fixed_inside || together > max_deviation) return std::nullopt;
  const RadialBounds &inner = moving_inside ? m : f, &outer = moving_inside ? f : m;
  return CylinderFit{moving_inside,
                     moving_inside ? *moving_axis_ : *fixed_axis_,
                     moving_inside ? *fixed_axis_ : *moving_axis_,
                     inner.begin,
                     inner.end,
                     outer.begin,
                     outer.end,
                     inner.max_radius,
                     static_cast<double>(outer.min_radius) - static_cast<double>(inner.max_radius),
                     together};
}

std::vector<RadialSweeps::AxisPair> RadialSweeps::nearest_pairs() const {
  std::vector<AxisPair> pairs;
  const double size = std::min(moving_->size(), fixed_->size());
  for (std::size_t i = 0; i < moving_->axes().size(); ++i) {
    const Line a = moved(motion_.t0, line_of(moving_->axes()[i], moving_origin_));
    for (std::size_t j = 0; j < fixed_->axes().size(); ++j) {
      const Line b = line_of(fixed_->axes()[j], fixed_origin_);
      if (length_squared(cross(a.direction, b.direction)) > kMaxSine * kMaxSine) continue;
      const double off = length(across(a.point - b.point, b.direction));
      const RevolutionAxis &of_moving = moving_->axes()[i], &of_fixed = fixed_->axes()[j];
      const double room =
          std::max(of_moving.max_radius - of_fixed.min_radius, of_fixed.max_radius - of_moving.min_radius);
      if (off <= std::min(kMaxOff * size, std::max(kOffWithoutRoom * size, room))) pairs.push_back({i, j, off});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const AxisPair& x, const AxisPair& y) {
    if (x.off != y.off) return x.off < y.off;
    return x.moving != y.moving ? x.moving < y.moving : x.fixed < y.fixed;
  });
  if (pairs.size() > kMaxPairs) pairs.resize(kMaxPairs);
  return pairs;
}

RadialSweep RadialSweeps::sweep(const AxisPair& pair) const {
  RadialSweep sweep;
  sweep.moving_ = &moving_->bounds_about(pair.moving);
  sweep.fixed_ = &fixed_->bounds_about(pair.fixed);
  sweep.moving_axis_ = &moving_->axes()[pair.moving];
  sweep.fixed_axis_ = &fixed_->axes()[pair.fixed];
  const Line own = line_of(moving_->axes()[pair.moving], moving_origin_);
  const Line other = line_of(fixed_->axes()[pair.fixed], fixed_origin_);
  for (int end = 0; end < 2; ++end) {
    const RigidTransform& t = end == 0 ? motion_.t0 : motion_.t1;
    const Line there = moved(t, own), back = moved(inverse(t), other);
    sweep.moving_off_.at[end] = across(there.point - other.point, other.direction);
    sweep.moving_off_.along[end] = across(there.direction, other.direction);
    sweep.fixed_off_.at[end] = across(back.point - own.point, own.direction);
    sweep.fixed_off_.along[end] = across(back.direction, own.direction);
    sweep.moving_off_.beside[end] = dot(there.point - other.point, other.direction);
    sweep.fixed_off_.beside[end] = dot(back.point - own.point, own.direction);
    const double cosine = dot(there.direction, other.direction), sine = length(cross(there.direction, other.direction));
    for (RadialSweep::Off* off : {&sweep.moving_off_, &sweep.fixed_off_}) {
      off->ahead[end] = cosine;
      off->max_aside = std::max(off->max_aside, sine);
    }
  }
  for (const auto& [off, nodes] : {std::pair{&sweep.moving_off_, sweep.moving_}, {&sweep.fixed_off_, sweep.fixed_}})
    for (int end = 0; end < 2; ++end)
      for (const float position : {(*nodes)[0].begin, (*nodes)[0].end})
        sweep.max_off_ =
            std::max(sweep.max_off_, length(off->at[end] + static_cast<double>(position) * off->along[end]));
  const Line seen = moved(inverse(motion_.t0), other);
  const RadialBounds& all = (*sweep.fixed_)[0];
  double rho = 0;
  for (const float position : {all.begin, all.end})
    rho = std::max(
        rho, screw_radius(motion_.back, seen.point + static_cast<double>(position) * seen.direction, all.max_radius));
  sweep.fixed_bend_ = std::max(0.0, screw_chord_deviation(motion_.back, rho) - motion_.kept) - motion_.deviation;
  return sweep;
}

Span<const RadialSweep> RadialSweeps::get() const {
  std::call_once(once_, [&] {
    for (const AxisPair& pair : nearest_pairs()) sweeps_.push_back(sweep(pair));
  });
  return sweeps_;
}

}  // namespace dismantle
