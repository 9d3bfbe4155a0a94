// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/front/radial_separation.h"

#include "dismantle/math/vec3f.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dismantle {

namespace {

/// So many pairs of axes are looked at in a sweep, those that are nearest as it begins.
constexpr std::size_t kMaxPairs = 3;
/// Axes are near each other where the sine of the angle between them is at most this,
constexpr double kMaxSine = 0.1;
/// and one's point is off the other by no more than this share of the smaller component's size.
constexpr double kMaxOff = 0.05;
/// What places along axes may be off by [mm].
constexpr double kPlaceRounding = 1e-6;
/// What is further apart than this share of the outer surface's radius is said to be so far apart.
constexpr double kPastEnds = 0.1;

/// An axis in a frame.
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
  const double aside = max_aside * static_cast<double>(inner.most) + kPlaceRounding + past;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (int end = 0; end < 2; ++end)
    for (const double border : {static_cast<double>(outer.begin) - aside, static_cast<double>(outer.end) + aside}) {
      const double place = (border - beside[end]) / ahead[end];
      least = std::min(least, place);
      most = std::max(most, place);
    }
  const double begin = inner.begin, end = inner.end;
  return {std::clamp(least, begin, end), std::clamp(most, begin, end)};
}

double RadialSweep::Off::most(const RadialBounds& inner, const RadialBounds& outer, double room) const {
  const double least = toward(inner, outer, 0);
  if (room <= least) return least;
  // They are apart, but what is past the ends may be nearer.
  const double past = kPastEnds * static_cast<double>(outer.least);
  return std::max(room - past, std::min(room, toward(inner, outer, past)));
}

double RadialSweep::Off::toward(const RadialBounds& inner, const RadialBounds& outer, double past) const {
  const Vec3 middle = to_double(outer.toward);
  const double cosine = outer.cosine, sine = outer.sine;
  const auto [begin, stop] = part_beside(inner, outer, past);
  double most = -std::numeric_limits<double>::infinity();  // convex along the axis
  for (int end = 0; end < 2; ++end)
    for (const double place : {begin, stop}) {
      const Vec3 off = at[end] + place * along[end];
      const double size = length(off), along_middle = dot(off, middle);
      // The least angle between it and a direction of the sector is what is left of that to its middle.
      const double across_it = std::sqrt(std::max(0.0, size * size - along_middle * along_middle));
      most = std::max(most, along_middle >= cosine * size ? size : along_middle * cosine + across_it * sine);
    }
  return most;
}

std::optional<CylinderFit> RadialSweep::fit(std::uint32_t moving, std::uint32_t fixed, double spread) const {
  const RadialBounds &m = (*moving_)[moving], &f = (*fixed_)[fixed];
  const bool moving_inside = m.clear_out && f.clear_in, fixed_inside = f.clear_out && m.clear_in;
  const double together = static_cast<double>(m.spread) + static_cast<double>(f.spread);
  if (moving_inside == fixed_inside || together > spread) return std::nullopt;
  const RadialBounds &inner = moving_inside ? m : f, &outer = moving_inside ? f : m;
  return CylinderFit{moving_inside,
                     moving_inside ? *moving_axis_ : *fixed_axis_,
                     moving_inside ? *fixed_axis_ : *moving_axis_,
                     inner.begin,
                     inner.end,
                     outer.begin,
                     outer.end,
                     inner.most,
                     static_cast<double>(outer.least) - static_cast<double>(inner.most),
                     together};
}

std::vector<RadialSweeps::AxisPair> RadialSweeps::nearest_pairs() const {
  std::vector<AxisPair> pairs;
  const double most = kMaxOff * std::min(moving_->size(), fixed_->size());
  for (std::size_t i = 0; i < moving_->axes().size(); ++i) {
    const Line a = moved(motion_.t0, line_of(moving_->axes()[i], moving_origin_));
    for (std::size_t j = 0; j < fixed_->axes().size(); ++j) {
      const Line b = line_of(fixed_->axes()[j], fixed_origin_);
      if (length_squared(cross(a.direction, b.direction)) > kMaxSine * kMaxSine) continue;
      const double off = length(across(a.point - b.point, b.direction));
      if (off <= most) pairs.push_back({i, j, off});
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
  sweep.moving_ = &moving_->about(pair.moving);
  sweep.fixed_ = &fixed_->about(pair.fixed);
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
      for (const float place : {(*nodes)[0].begin, (*nodes)[0].end})
        sweep.max_off_ = std::max(sweep.max_off_, length(off->at[end] + static_cast<double>(place) * off->along[end]));
  const Line seen = moved(inverse(motion_.t0), other);
  const RadialBounds& all = (*sweep.fixed_)[0];
  double rho = 0;
  for (const float place : {all.begin, all.end})
    rho = std::max(rho, screw_radius(motion_.back, seen.point + static_cast<double>(place) * seen.direction, all.most));
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
