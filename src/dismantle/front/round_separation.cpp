// SPDX-License-Identifier: Apache-2.0
#include "dismantle/front/round_separation.h"

#include "dismantle/math/vec3f.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dismantle {

namespace {

/// So many pairs of axes are looked at in a sweep, those that are nearest as it begins.
constexpr std::size_t kMostPairs = 3;
/// Axes are near each other where the sine of the angle between them is at most this,
constexpr double kMostSine = 0.1;
/// and one's point is off the other by no more than this share of the smaller component's size.
constexpr double kMostOff = 0.05;

/// An axis in a frame.
struct Line {
  Vec3 point, direction;
};

Line line_of(const RoundAxis& axis, Vec3 origin) {
  return {axis.point - origin, axis.direction};
}
Line moved(const RigidTransform& t, const Line& line) {
  return {t * line.point, t.rotation * line.direction};
}
Vec3 across(Vec3 v, Vec3 direction) {
  return v - dot(v, direction) * direction;
}

}  // namespace

double RoundSweep::Off::most(const RoundNode& inner, const RoundNode& outer) const {
  const Vec3 toward = to_double(outer.toward);
  const double cosine = outer.cosine, sine = outer.sine;
  double most = -std::numeric_limits<double>::infinity();  // convex along the axis
  for (int end = 0; end < 2; ++end)
    for (const float place : {inner.begin, inner.end}) {
      const Vec3 off = at[end] + static_cast<double>(place) * along[end];
      const double size = length(off), ahead = dot(off, toward);
      // The least angle between it and a direction of the sector is what is left of that to its middle.
      const double aside = std::sqrt(std::max(0.0, size * size - ahead * ahead));
      most = std::max(most, ahead >= cosine * size ? size : ahead * cosine + aside * sine);
    }
  return most;
}

std::vector<RoundSweeps::AxisPair> RoundSweeps::nearest_pairs() const {
  std::vector<AxisPair> pairs;
  const double most = kMostOff * std::min(moving_->size(), fixed_->size());
  for (std::size_t i = 0; i < moving_->axes().size(); ++i) {
    const Line a = moved(motion_.t0, line_of(moving_->axes()[i], moving_origin_));
    for (std::size_t j = 0; j < fixed_->axes().size(); ++j) {
      const Line b = line_of(fixed_->axes()[j], fixed_origin_);
      if (length_squared(cross(a.direction, b.direction)) > kMostSine * kMostSine) continue;
      const double off = length(across(a.point - b.point, b.direction));
      if (off <= most) pairs.push_back({i, j, off});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const AxisPair& x, const AxisPair& y) {
    if (x.off != y.off) return x.off < y.off;
    return x.moving != y.moving ? x.moving < y.moving : x.fixed < y.fixed;
  });
  if (pairs.size() > kMostPairs) pairs.resize(kMostPairs);
  return pairs;
}

RoundSweep RoundSweeps::sweep(const AxisPair& pair) const {
  RoundSweep sweep;
  sweep.moving_ = &moving_->about(pair.moving);
  sweep.fixed_ = &fixed_->about(pair.fixed);
  const Line own = line_of(moving_->axes()[pair.moving], moving_origin_);
  const Line other = line_of(fixed_->axes()[pair.fixed], fixed_origin_);
  for (int end = 0; end < 2; ++end) {
    const RigidTransform& t = end == 0 ? motion_.t0 : motion_.t1;
    const Line there = moved(t, own), back = moved(inverse(t), other);
    sweep.moving_off_.at[end] = across(there.point - other.point, other.direction);
    sweep.moving_off_.along[end] = across(there.direction, other.direction);
    sweep.fixed_off_.at[end] = across(back.point - own.point, own.direction);
    sweep.fixed_off_.along[end] = across(back.direction, own.direction);
  }
  for (const auto& [off, nodes] : {std::pair{&sweep.moving_off_, sweep.moving_}, {&sweep.fixed_off_, sweep.fixed_}})
    for (int end = 0; end < 2; ++end)
      for (const float place : {(*nodes)[0].begin, (*nodes)[0].end})
        sweep.most_off_ =
            std::max(sweep.most_off_, length(off->at[end] + static_cast<double>(place) * off->along[end]));
  const Line seen = moved(inverse(motion_.t0), other);
  const RoundNode& all = (*sweep.fixed_)[0];
  double rho = 0;
  for (const float place : {all.begin, all.end})
    rho = std::max(rho, screw_radius(motion_.back, seen.point + static_cast<double>(place) * seen.direction, all.most));
  sweep.fixed_bend_ = std::max(0.0, screw_chord_deviation(motion_.back, rho) - motion_.kept) - motion_.deviation;
  return sweep;
}

Span<const RoundSweep> RoundSweeps::get() const {
  std::call_once(once_, [&] {
    for (const AxisPair& pair : nearest_pairs()) sweeps_.push_back(sweep(pair));
  });
  return sweeps_;
}

}  // namespace dismantle
