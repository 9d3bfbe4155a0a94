// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/radial_bounds.h"

#include "dismantle/features/axis_frame.h"
#include "dismantle/math/angle.h"
#include "dismantle/math/vec3f.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace dismantle {

namespace {

/// Bounds the rounding of a distance from the axis, relative to the coordinates.
constexpr double kRounding = 1e-13;
/// The cosine of 45 degrees.
constexpr double kFacing = 0.70710678;
/// A face lies across the axis if the part of its unit normal perpendicular to the axis is at most this long.
constexpr double kAcross = 0.04;

/// A vertex in coordinates about an axis.
struct Corner {
  Vec3 across;           // from the axis
  double distance = 0;   // from the axis
  double along = 0;      // from the axis' point
  double angle = 0;      // [rad]
  double magnitude = 0;  // of its largest coordinate
};

Corner corner_at(Vec3 p, const AxisFrame& axis) {
  const Vec3 across = axis.across(p);
  return {across, length(across), axis.along(p), axis.angle(across), max_abs(p)};
}

/// The corners of a face.
using Corners = std::array<const Corner*, 3>;

/// The distance of the triangle from the axis, in the projection along it.
double min_distance(const Corners& c, Vec3 axis) {
  double sides[3], nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Vec3 p = c[i]->across, q = c[(i + 1) % 3]->across;
    sides[i] = dot(axis, cross(p, q));
    nearest = std::min(nearest, AxisFrame::distance_of_segment(p, q));
  }
  const bool around =
      (sides[0] >= 0 && sides[1] >= 0 && sides[2] >= 0) || (sides[0] <= 0 && sides[1] <= 0 && sides[2] <= 0);
  return around ? 0 : nearest;
}

constexpr double kHalfTurn = 3.14159265358979;
/// Prisms lack a third of the deviation; the rest is for rounding.
constexpr double kWallShare = 0.4;
/// Bounds the error of a sector's angles [rad].
constexpr double kAngleRounding = 1e-6;

/// A sector of directions about an axis: those within `half` of `center` [rad].
struct Sector {
  double center = 0, half = kHalfTurn;
};

Sector both(const Sector& x, const Sector& y) {
  const double from_x = nearest_remainder(y.center - x.center, 2 * kHalfTurn);
  const double low = std::min(-x.half, from_x - y.half), high = std::max(x.half, from_x + y.half);
  return {x.center + (low + high) / 2, std::min(kHalfTurn, (high - low) / 2)};
}

void set_sector(RadialBounds& node, const Sector& sector, const AxisFrame& axis) {
  node.toward = to_float(axis.at(sector.center));
  const double half = sector.half + kAngleRounding;
  node.cosine = half < kHalfTurn ? static_cast<float>(std::cos(half)) : -1;
  node.sine = half < kHalfTurn ? static_cast<float>(std::sin(half)) : 0;
}

/// The sector of a triangle that the axis does not pass through.
Sector sector_of(const Corners& corners) {
  Sector sector{corners[0]->angle, 0};
  for (int i = 1; i < 3; ++i) sector = both(sector, {corners[i]->angle, 0});
  return sector;
}

/// The faces of a node that do not lie across the axis.
struct Wall {
  float min_radius = std::numeric_limits<float>::infinity(), max_radius = 0;  // distances [mm]
  double area = 0;                                                            // [mm^2]
};

Wall both(const Wall& x, const Wall& y) {
  return {std::min(x.min_radius, y.min_radius), std::max(x.max_radius, y.max_radius), x.area + y.area};
}

/// RadialBounds::radial_deviation of a node with this wall. A prism of n sides and radius r has 1 - pi^2 / 6n^2 of the
/// cylinder's area, and distances that differ by r pi^2 / 2n^2: with less area it has gaps, with more than that of the
/// cylinder it is none.
float radial_deviation_of(const Wall& wall, const RadialBounds& node) {
  const double deviation = static_cast<double>(wall.max_radius) - static_cast<double>(wall.min_radius);
  const double height = static_cast<double>(node.end) - static_cast<double>(node.begin);
  const double radius = static_cast<double>(wall.max_radius), turned = wall.area / (2 * kHalfTurn * height);
  const bool whole = turned >= radius - kWallShare * deviation && turned <= radius * (1 + kAngleRounding);
  return whole ? rounded_up(deviation) : std::numeric_limits<float>::infinity();
}

/// The triangles of a node.
struct Bounded {
  RadialBounds bounds;  // without its sector and deviation
  Sector sector;
  Wall wall;
};

Bounded about_axis(const AxisFrame& axis, const Triangle& triangle, const Corners& corners) {
  const Vec3 normal = normal_unscaled(triangle);
  double size = max_abs(axis.point);
  double max_radius = 0, begin = std::numeric_limits<double>::infinity(), end = -begin;
  Bounded face;
  RadialBounds& node = face.bounds;
  bool faces_out = true, faces_in = true;
  for (const Corner* c : corners) {
    size = std::max(size, c->magnitude);
    max_radius = std::max(max_radius, c->distance);
    begin = std::min(begin, c->along);
    end = std::max(end, c->along);
    const double enough = kFacing * c->distance * length(normal), facing = dot(normal, c->across);
    faces_out &= facing > enough;
    faces_in &= facing < -enough;
  }
  const double rounding = kRounding * size;
  const bool lies_across = length(cross(normal, axis.direction)) <= kAcross * length(normal);
  node.clear_out = faces_out || lies_across;
  node.clear_in = faces_in || lies_across;
  const double min_radius = min_distance(corners, axis.direction);
  if (min_radius > rounding) face.sector = sector_of(corners);
  node.min_radius = -rounded_up(rounding - min_radius);
  node.max_radius = rounded_up(max_radius + rounding);
  node.begin = -rounded_up(rounding - begin);
  node.end = rounded_up(end + rounding);
  if (!lies_across) face.wall = {node.min_radius, node.max_radius, length(normal) / 2};
  return face;
}

RadialBounds both(const RadialBounds& x, const RadialBounds& y) {
  return {std::min(x.min_radius, y.min_radius),
          std::max(x.max_radius, y.max_radius),
          std::min(x.begin, y.begin),
          std::max(x.end, y.end),
          {},
          -1,
          0,
          x.clear_out && y.clear_out,
          x.clear_in && y.clear_in};
}

Bounded both(const Bounded& x, const Bounded& y) {
  return {both(x.bounds, y.bounds), both(x.sector, y.sector), both(x.wall, y.wall)};
}

}  // namespace

RevolutionSurface::RevolutionSurface(Span<const Vec3> vertices, Span<const Face> faces, Span<const ObbNode> nodes,
                                     std::vector<RevolutionAxis> axes, std::vector<ThreadAxis> threads)
    : vertices_(vertices),
      faces_(faces),
      nodes_(nodes),
      axes_(std::move(axes)),
      threads_(std::move(threads)),
      bounds_about_(std::make_unique<BoundsAbout[]>(axes_.size())) {
  if (axes_.empty()) return;
  const std::vector<std::uint32_t> order = node_order();
  std::vector<std::uint32_t> counts(nodes_.size(), 1);
  for (auto i = order.rbegin(); i != order.rend(); ++i) {
    const ObbNode& node = nodes_[*i];
    if (!node.leaf()) counts[*i] = counts[node.child] + counts[node.child + 1];
  }
  slots_.assign(nodes_.size(), 0);
  for (const std::uint32_t i : order)
    if (counts[i] >= kLargeNode) slots_[i] = ++large_count_;
}

std::vector<std::uint32_t> RevolutionSurface::node_order() const {
  std::vector<std::uint32_t> order;
  order.reserve(nodes_.size());
  order.push_back(0);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const ObbNode& node = nodes_[order[k]];
    if (!node.leaf()) order.insert(order.end(), {node.child, node.child + 1});
  }
  return order;
}

double RevolutionSurface::size() const {
  const Vec3f half = nodes_[0].box.half;
  return 2 * static_cast<double>(std::max({half.x, half.y, half.z}));
}

const RadialBoundsList& RevolutionSurface::bounds_about(std::size_t axis) const {
  BoundsAbout& known = bounds_about_[axis];
  std::call_once(known.once, [&] {
    const AxisFrame frame(axes_[axis].point, axes_[axis].direction);
    RadialBounds unknown;
    unknown.max_radius = std::numeric_limits<float>::infinity();
    known.nodes.slots_ = &slots_;
    known.nodes.nodes_.assign(1 + large_count_, unknown);
    std::vector<Corner> corners;
    corners.reserve(vertices_.size());
    for (const Vec3& p : vertices_) corners.push_back(corner_at(p, frame));
    // Depth first: the nodes of a subtree are next to each other in memory.
    const std::function<Bounded(std::uint32_t)> bound = [&](std::uint32_t i) {
      const ObbNode& node = nodes_[i];
      if (node.leaf()) {
        const Face& f = faces_[node.child];
        const Triangle triangle{{vertices_[f.v[0]], vertices_[f.v[1]], vertices_[f.v[2]]}};
        return about_axis(frame, triangle, {&corners[f.v[0]], &corners[f.v[1]], &corners[f.v[2]]});
      }
      Bounded all = both(bound(node.child), bound(node.child + 1));
      if (slots_[i] == 0) return all;
      set_sector(all.bounds, all.sector, frame);
      all.bounds.radial_deviation = radial_deviation_of(all.wall, all.bounds);
      known.nodes.nodes_[slots_[i]] = all.bounds;
      return all;
    };
    if (large_count_ > 0) bound(0);
  });
  return known.nodes;
}

}  // namespace dismantle
