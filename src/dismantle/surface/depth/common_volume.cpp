// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/depth/common_volume.h"

#include "dismantle/geometry/aabb_corners.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace dismantle {

namespace {

constexpr std::size_t kCells = 20;     // along each side of the grid
constexpr std::size_t kFirstRays = 2;  // in each cell, so that there is a variance
constexpr std::size_t kRaysARound = 1000;
constexpr int kTries = 4;  // rays near an edge are moved

/// A number in [0, 1) that depends on its arguments alone (the mixer of SplitMix64).
double random_number(std::uint64_t cell, std::uint64_t ray, std::uint64_t coordinate) {
  std::uint64_t x = (cell * 0x100000 + ray) * 8 + coordinate + 1;
  x *= 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((x ^ (x >> 31)) >> 11) * 0x1p-53;
}

/// The lengths of a cell's rays in both solids.
struct Cell {
  std::size_t rays = 0;
  double sum = 0, squares = 0;

  double mean() const { return sum / static_cast<double>(rays); }
  /// Of one ray.
  double variance() const {
    const double n = static_cast<double>(rays);
    return rays < 2 ? 0 : std::max(0.0, (squares - sum * sum / n) / (n - 1));
  }
};

/// Length of the part of a ray where both winding numbers are not 0.
double common_length(const std::vector<SurfaceCrossing>& a, const std::vector<SurfaceCrossing>& b) {
  double length = 0, from = 0;
  int winding_a = 0, winding_b = 0;
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
    const bool next_a = j == b.size() || (i < a.size() && a[i].distance <= b[j].distance);
    const SurfaceCrossing& at = next_a ? a[i++] : b[j++];
    if (winding_a != 0 && winding_b != 0) length += at.distance - from;
    from = at.distance;
    (next_a ? winding_a : winding_b) -= at.winding;
  }
  return length;
}

/// Rays through the box where both components are, in the frame of the first one.
class VolumeRays {
 public:
  VolumeRays(const PlacedShape& a, const PlacedShape& b, int axis)
      : a_(*a.shape),
        b_(*b.shape),
        b_from_a_(inverse(b.world_from_assembled) * a.world_from_assembled),
        axis_(axis),
        cells_(kCells * kCells) {
    const RigidTransform a_from_b = inverse(b_from_a_);
    Aabb other;
    for (const Vec3& corner : corners_of(b_.get().surface().bounds())) other.extend(a_from_b * corner);
    box_ = {max(a_.get().surface().bounds().lower, other.lower), min(a_.get().surface().bounds().upper, other.upper)};
  }

  /// True if both are nowhere.
  bool empty() const { return box_.empty(); }

  /// The first rays of every cell.
  CommonVolume begin() {
    for (std::size_t c = 0; c < cells_.size(); ++c) add_rays(c, kFirstRays);
    return estimate();
  }

  /// More rays, where they are needed.
  CommonVolume finish(const VolumeOptions& options) {
    CommonVolume now = estimate();
    while (now.rays < options.rays && now.standard_error > options.relative_error * now.volume) {
      add_round();
      now = estimate();
    }
    return now;
  }

 private:
  /// The ray through a point of a cell, both given in [0, 1); nothing near an edge.
  std::optional<double> length_at(std::size_t cell, double u, double v) const {
    Vec3 point = box_.lower, direction;
    const Vec3 size = box_.size();
    const int across = (axis_ + 1) % 3, up = (axis_ + 2) % 3;
    const std::size_t column = cell % kCells, row = cell / kCells;
    point[across] += size[across] * (static_cast<double>(column) + u) / kCells;
    point[up] += size[up] * (static_cast<double>(row) + v) / kCells;
    // From before both, so that winding numbers begin at 0.
    const double before = diagonal(a_.get().surface().bounds()) + diagonal(b_.get().surface().bounds());
    point[axis_] -= before;
    direction[axis_] = 1;
    const auto first = a_.get().winding().crossings(point, direction);
    if (!first) return std::nullopt;
    if (first->empty()) return 0;
    const auto second = b_.get().winding().crossings(b_from_a_ * point, b_from_a_.rotation * direction);
    if (!second) return std::nullopt;
    return common_length(*first, *second);
  }

  void add_rays(std::size_t c, std::size_t count) {
    Cell& cell = cells_[c];
    for (std::size_t k = 0; k < count; ++k) {
      std::optional<double> length;
      for (int attempt = 0; attempt < kTries && !length; ++attempt) {
        const std::uint64_t move = 2 * static_cast<std::uint64_t>(attempt);
        length = length_at(c, random_number(c, cell.rays, move), random_number(c, cell.rays, move + 1));
      }
      ++cell.rays;
      cell.sum += length.value_or(0);
      cell.squares += length.value_or(0) * length.value_or(0);
    }
  }

  /// Adds rays to the cells in proportion to the deviation of theirs and their neighbours' rays.
  void add_round() {
    std::vector<double> deviation(cells_.size());
    double sum = 0;
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const std::size_t x = c % kCells, y = c / kCells;
      double greatest = cells_[c].variance();
      if (x > 0) greatest = std::max(greatest, cells_[c - 1].variance());
      if (x + 1 < kCells) greatest = std::max(greatest, cells_[c + 1].variance());
      if (y > 0) greatest = std::max(greatest, cells_[c - kCells].variance());
      if (y + 1 < kCells) greatest = std::max(greatest, cells_[c + kCells].variance());
      sum += deviation[c] = std::sqrt(greatest);
    }
    for (std::size_t c = 0; c < cells_.size(); ++c)
      add_rays(c, static_cast<std::size_t>(std::ceil(kRaysARound * deviation[c] / sum)));
  }

  CommonVolume estimate() const {
    CommonVolume now;
    double mean = 0, variance = 0;
    for (const Cell& cell : cells_) {
      now.rays += cell.rays;
      mean += cell.mean();
      variance += cell.variance() / static_cast<double>(cell.rays);
    }
    const Vec3 size = box_.size();
    const double area = size[(axis_ + 1) % 3] * size[(axis_ + 2) % 3] / static_cast<double>(cells_.size());
    now.volume = mean * area;
    now.standard_error = std::sqrt(variance) * area;
    return now;
  }

  std::reference_wrapper<const SolidShape> a_, b_;
  RigidTransform b_from_a_;
  Aabb box_;
  int axis_;
  std::vector<Cell> cells_;
};

}  // namespace

CommonVolume common_volume(const PlacedShape& a, const PlacedShape& b, const VolumeOptions& options) {
  if (a.shape->empty() || b.shape->empty()) return {};
  // The direction in which the rays differ least.
  std::optional<VolumeRays> best;
  CommonVolume best_found;
  std::size_t others = 0;
  for (int axis = 0; axis < 3; ++axis) {
    VolumeRays rays(a, b, axis);
    if (rays.empty()) return {};
    const CommonVolume found = rays.begin();
    others += found.rays;
    const bool better = found.standard_error * best_found.volume < best_found.standard_error * found.volume;
    if (best && !better && best_found.volume > 0) continue;
    best.emplace(std::move(rays));
    best_found = found;
  }
  others -= best_found.rays;
  CommonVolume found = best->finish(options);
  found.rays += others;
  return found;
}

}  // namespace dismantle
