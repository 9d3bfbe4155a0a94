// SPDX-License-Identifier: Apache-2.0
#include "dismantle/math/least_vector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace dismantle {

namespace {

/// Bounds count as met if they are missed by this share of the largest distance.
constexpr double kSlack = 1e-9;
/// A bound whose normal is within this of the span of those that hold with equality cannot be met together with them,
/// or is met anyway.
constexpr double kParallel = 1e-6;

/// A bound in a linear subspace: as VectorBound, with a normal of any length.
struct Projected {
  Vec3 normal;
  double distance = 0;
};

/// The bound for the rest of a vector, perpendicular to `unit`, once its part `fixed` is decided.
Projected projected(const Projected& bound, Vec3 unit, Vec3 fixed) {
  return {bound.normal - dot(bound.normal, unit) * unit, bound.distance - dot(bound.normal, fixed)};
}

/// The shortest vector on a line that is within the bounds.
std::optional<Vec3> least_on_line(Span<const Projected> bounds, Vec3 direction, double slack) {
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  for (const Projected& b : bounds) {
    const double along = dot(b.normal, direction);
    if (std::abs(along) < kParallel) {
      if (b.distance > slack) return std::nullopt;
    } else if (along > 0) {
      low = std::max(low, b.distance / along);
    } else {
      high = std::min(high, b.distance / along);
    }
  }
  if (low > high + slack) return std::nullopt;
  return std::clamp(0.0, std::min(low, high), high) * direction;
}

/// The shortest vector perpendicular to `across` that is within the bounds.
std::optional<Vec3> least_in_plane(Span<const Projected> bounds, Vec3 across, double slack) {
  Vec3 least;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (dot(bounds[i].normal, least) >= bounds[i].distance - slack) continue;
    const double size = length(bounds[i].normal);
    if (size < kParallel) return std::nullopt;
    const Vec3 unit = bounds[i].normal / size, nearest = (bounds[i].distance / size) * unit;
    std::vector<Projected> before;
    for (std::size_t k = 0; k < i; ++k) before.push_back(projected(bounds[k], unit, nearest));
    const std::optional<Vec3> along = least_on_line(before, normalized(cross(across, unit)), slack);
    if (!along) return std::nullopt;
    least = nearest + *along;
  }
  return least;
}

}  // namespace

std::optional<Vec3> least_vector(Span<const VectorBound> bounds) {
  double largest = 0;
  for (const VectorBound& b : bounds) largest = std::max(largest, std::abs(b.distance));
  const double slack = kSlack * largest;
  Vec3 least;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (dot(bounds[i].normal, least) >= bounds[i].distance - slack) continue;
    const Vec3 unit = bounds[i].normal, nearest = bounds[i].distance * unit;
    std::vector<Projected> before;
    for (std::size_t k = 0; k < i; ++k)
      before.push_back(projected({bounds[k].normal, bounds[k].distance}, unit, nearest));
    const std::optional<Vec3> rest = least_in_plane(before, unit, slack);
    if (!rest) return std::nullopt;
    least = nearest + *rest;
  }
  return least;
}

}  // namespace dismantle
