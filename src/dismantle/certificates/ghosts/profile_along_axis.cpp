// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/profile_along_axis.h"

#include "dismantle/math/angle.h"

#include <algorithm>
#include <cmath>

namespace dismantle {

namespace {

/// Edges reach this share of their length beyond their ends: none is missed between two by rounding.
constexpr double kBeyondEnds = 1e-9;
/// Corners this share within the outline belong to it.
constexpr double kOnOutline = 1e-9;

/// The angle from one to another, the short way round [rad].
double turn_between(double from, double to) {
  return std::remainder(to - from, kTurn);
}

}  // namespace

std::size_t ProfileAlongAxis::bin_of(double angle) {
  const double share = angle / kTurn - std::floor(angle / kTurn);
  return std::min(kBins - 1, static_cast<std::size_t>(share * kBins));
}

/// Calls visit(bin) for the bins from one angle to another, the short way round.
template <class Visit>
void ProfileAlongAxis::for_each_bin(double from, double to, const Visit& visit) {
  if (turn_between(from, to) < 0) std::swap(from, to);
  for (std::size_t bin = bin_of(from), last = bin_of(to);; bin = (bin + 1) % kBins) {
    visit(bin);
    if (bin == last) return;
  }
}

ProfileAlongAxis::ProfileAlongAxis(const AxisFrame& axis, const std::vector<Triangle>& faces, bool farthest)
    : axis_(axis), farthest_(farthest) {
  for (const Triangle& face : faces)
    for (int i = 0; i < 3; ++i) {
      const Vec3 from = axis_.across(face[i]), to = axis_.across(face[(i + 1) % 3]);
      const auto edge = static_cast<std::uint32_t>(edges_.size());
      edges_.push_back({from, to - from});
      for_each_bin(axis_.angle(from), axis_.angle(to), [&](std::size_t bin) { edges_in_[bin].push_back(edge); });
    }
  for (const Edge& edge : edges_) {
    const Corner corner{axis_.angle(edge.from), length(edge.from)};
    const std::optional<double> outline = distance(corner.angle);
    const bool inside = outline && beyond(*outline, corner.distance * (farthest_ ? 1 + kOnOutline : 1 - kOnOutline));
    if (!inside) corners_in_[bin_of(corner.angle)].push_back(corner);
  }
}

std::optional<double> ProfileAlongAxis::distance(double angle) const {
  const Vec3 direction = axis_.at(angle);
  const Vec3 aside = cross(axis_.direction, direction);
  std::optional<double> found;
  const auto take = [&](double distance) {
    if (distance >= 0 && (!found || beyond(distance, *found))) found = distance;
  };
  for (const std::uint32_t e : edges_in_[bin_of(angle)]) {
    const Edge& edge = edges_[e];
    const double off = dot(aside, edge.from), slope = dot(aside, edge.along);
    if (slope == 0) {
      if (off != 0) continue;
      take(dot(direction, edge.from));
      take(dot(direction, edge.from + edge.along));
      continue;
    }
    const double t = -off / slope;
    if (t >= -kBeyondEnds && t <= 1 + kBeyondEnds) take(dot(direction, edge.from + t * edge.along));
  }
  return found;
}

double ProfileAlongAxis::ratio_to_segment(Vec3 a, Vec3 b) const {
  std::optional<double> ratio;
  const Vec3 along = b - a;
  const auto look_at = [&](double angle, double distance) {
    const Vec3 direction = axis_.at(angle), aside = cross(axis_.direction, direction);
    const double slope = dot(aside, along);
    const double t = slope != 0 ? std::clamp(-dot(aside, a) / slope, 0.0, 1.0) : 0;
    const double mine = dot(direction, a + t * along);
    if (mine > 0 && (!ratio || beyond(distance / mine, *ratio))) ratio = distance / mine;
  };
  const double from = axis_.angle(a), to = axis_.angle(b), turn = turn_between(from, to);
  for (const double end : {from, to})
    if (const auto outline = distance(end)) look_at(end, *outline);
  for_each_bin(from, to, [&](std::size_t bin) {
    for (const Corner& corner : corners_in_[bin]) {
      const double share = turn_between(from, corner.angle) / turn;
      if (share > 0 && share < 1) look_at(corner.angle, corner.distance);
    }
  });
  return ratio.value_or(1);
}

}  // namespace dismantle
