// SPDX-License-Identifier: Apache-2.0
#include "dismantle/features/revolution_axes.h"

#include "dismantle/core/connected_sets.h"
#include "dismantle/features/axis_frame.h"
#include "dismantle/geometry/aabb.h"
#include "dismantle/geometry/adjacency.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

namespace dismantle {

namespace {

constexpr double kQuarterTurn = 1.5707963;
/// Faces that meet at a smaller sine are coplanar; those that meet at a smaller cosine form a corner.
constexpr double kMinSine = 1e-4;
constexpr double kMinCosine = 0.5;
/// Axes agree if the sine between them, and their distance relative to the box's diagonal, are no larger than these:
/// the sizes of the cells in which they are collected.
constexpr double kSameDirection = 1e-3;
constexpr double kSamePlace = 1e-4;
/// The origin of cells, so that round coordinates are not at their borders.
constexpr double kCellOffset = 0.3819660113;
/// Cells around which axes are sought: the smallest turn of the edges in one [rad], and how many there are at most.
constexpr double kMinCell = kQuarterTurn / 16;
constexpr std::size_t kMaxCells = 4096;

using Cell = std::array<std::int64_t, 6>;

std::int64_t cell_at(double x, double size) {
  return static_cast<std::int64_t>(std::floor(x / size + kCellOffset));
}

/// The vector with the sign that makes its largest coordinate positive.
Vec3 of_one_sign(Vec3 v) {
  const double x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
  const double largest = x >= y && x >= z ? v.x : y >= z ? v.y : v.z;
  return largest < 0 ? -v : v;
}

/// The third corner of a face.
Vec3 opposite(Span<const Vec3> vertices, const Face& face, const std::uint32_t (&edge)[2]) {
  for (const std::uint32_t v : face.v)
    if (v != edge[0] && v != edge[1]) return vertices[v];
  return vertices[edge[0]];
}

Vec3 normal_of(Span<const Vec3> vertices, const Face& f) {
  return normalized(normal_unscaled(Triangle{{vertices[f.v[0]], vertices[f.v[1]], vertices[f.v[2]]}}));
}

/// The axis of the cylinder that the edge of two faces is a ruling of; with zero turn if there is none.
RevolutionAxis axis_of(Span<const Vec3> vertices, Span<const Face> faces, const NeighbouringFaces& pair, Vec3 middle) {
  RevolutionAxis axis;
  const Face &a = faces[pair.face[0]], &b = faces[pair.face[1]];
  const Vec3 normal_a = normal_of(vertices, a), normal_b = normal_of(vertices, b);
  const double sine = length(cross(normal_a, normal_b));
  if (!(sine > kMinSine) || !(dot(normal_a, normal_b) > kMinCosine)) return axis;
  const Vec3 from = vertices[pair.edge[0]];
  axis.direction = of_one_sign(normalized(vertices[pair.edge[1]] - from));
  const auto across = [&](Vec3 v) { return v - dot(v, axis.direction) * axis.direction; };
  // The center of the circle through the edge and the two opposite corners, in the projection along the edge.
  const Vec3 p = across(opposite(vertices, a, pair.edge) - from), q = across(opposite(vertices, b, pair.edge) - from);
  const Vec3 normal = cross(p, q);
  const double square = length_squared(normal);
  if (!(square > 0)) return axis;
  const Vec3 center = from + cross(length_squared(p) * q - length_squared(q) * p, normal) / (2 * square);
  axis.point = middle + across(center - middle);
  axis.min_radius = axis.max_radius = length(center - from);
  axis.turn = std::asin(std::min(1.0, sine));
  return axis;
}

/// The sum of axes that agree, weighted by their turns.
struct AxisSum {
  Vec3 offset;  // from the middle of the mesh's box, times the turn
  Vec3 direction;
  double turn = 0;
  double min_radius = std::numeric_limits<double>::infinity(), max_radius = 0;

  void add(const RevolutionAxis& axis) {
    min_radius = std::min(min_radius, axis.min_radius);
    max_radius = std::max(max_radius, axis.max_radius);
    const double sign = dot(direction, axis.direction) < 0 ? -1 : 1;
    offset += axis.turn * axis.point;
    direction += sign * axis.turn * axis.direction;
    turn += axis.turn;
  }
  RevolutionAxis mean() const { return {offset / turn, normalized(direction), turn, min_radius, max_radius}; }
};

bool more_turn(const RevolutionAxis& x, const RevolutionAxis& y) {
  return x.turn > y.turn;
}

/// One axis for all cells that hold it.
std::vector<RevolutionAxis> joined(const std::map<Cell, AxisSum>& cells, double diagonal) {
  std::vector<RevolutionAxis> means, axes;
  means.reserve(cells.size());
  for (const auto& [cell, sum] : cells) means.push_back(sum.mean());
  std::stable_sort(means.begin(), means.end(), more_turn);
  // By a coordinate of their points, which are no further apart than this where axes agree.
  const double near = 2 * (kSamePlace + kSameDirection) * diagonal;
  std::vector<std::uint32_t> by_place(means.size());
  std::iota(by_place.begin(), by_place.end(), 0u);
  std::sort(by_place.begin(), by_place.end(),
            [&](std::uint32_t i, std::uint32_t k) { return means[i].point.x < means[k].point.x; });
  std::vector<bool> taken(means.size());
  for (std::size_t i = 0, seeds = 0; i < means.size() && means[i].turn >= kMinCell && seeds < kMaxCells; ++i) {
    if (taken[i]) continue;
    ++seeds;
    AxisSum sum;
    const RevolutionAxis& seed = means[i];
    auto k = std::partition_point(by_place.begin(), by_place.end(),
                                  [&](std::uint32_t m) { return means[m].point.x < seed.point.x - near; });
    for (; k != by_place.end() && means[*k].point.x <= seed.point.x + near; ++k)
      if (!taken[*k] && same_axis(seed, means[*k], kSameDirection, kSamePlace * diagonal)) {
        taken[*k] = true;
        sum.add(means[*k]);
      }
    if (sum.turn >= kQuarterTurn) axes.push_back(sum.mean());
  }
  return axes;
}

/// Relative difference between the distances from the axis of a cylinder's corners, at most.
constexpr double kOneDistance = 1e-3;
/// Cosine between the normal of a cylinder's face and the direction away from the axis, or to it, at least.
constexpr double kLeadsAway = 0.8;
/// Cylinders of fewer faces get no part.
constexpr std::size_t kMinOfCylinder = 12;

/// The mean distance from the axis of the corners of a cylinder's face, negative if its normal points to the axis [mm];
/// nothing for other faces.
std::optional<double> cylinder_distance(const AxisFrame& frame, const Triangle& triangle) {
  double distances[3];
  Vec3 away;
  for (int i = 0; i < 3; ++i) {
    const Vec3 across = frame.across(triangle[i]);
    distances[i] = length(across);
    away = away + across;
  }
  const double mean = (distances[0] + distances[1] + distances[2]) / 3;
  for (const double d : distances)
    if (std::abs(d - mean) > kOneDistance * mean) return std::nullopt;
  const Vec3 normal = normal_unscaled(triangle);
  const double facing = dot(normal, away), limit = kLeadsAway * length(normal) * length(away);
  if (std::abs(facing) <= limit) return std::nullopt;
  return facing > 0 ? mean : -mean;
}

/// The extent of a group of faces as a cylinder.
struct CylinderExtent {
  double area = 0, distance = 0;
  double begin = std::numeric_limits<double>::infinity(), end = -begin;
  std::size_t count = 0;
  /// The angle that it goes around if its length is the same all around [rad].
  double turn() const { return area / (distance * (end - begin)); }
};

}  // namespace

std::vector<RevolutionAxis> revolution_axes(Span<const Vec3> vertices, Span<const Face> faces) {
  Aabb box;
  for (const Vec3& p : vertices) box.extend(p);
  if (box.empty()) return {};
  const Vec3 middle = box.center();
  const double diagonal = length(box.size());
  std::map<Cell, AxisSum> cells;
  for (const NeighbouringFaces& pair : neighbouring_faces(faces)) {
    RevolutionAxis axis = axis_of(vertices, faces, pair, middle);
    const Vec3 offset = axis.point - middle, d = axis.direction;
    if (!(axis.turn > 0) || !(max_abs(offset) <= diagonal)) continue;
    axis.point = offset;
    const double size = kSamePlace * diagonal;
    cells[{cell_at(d.x, kSameDirection), cell_at(d.y, kSameDirection), cell_at(d.z, kSameDirection),
           cell_at(offset.x, size), cell_at(offset.y, size), cell_at(offset.z, size)}]
        .add(axis);
  }
  std::vector<RevolutionAxis> axes = joined(cells, diagonal);
  for (RevolutionAxis& axis : axes) axis.point += middle;
  std::stable_sort(axes.begin(), axes.end(), more_turn);
  if (axes.size() > kMaxRevolutionAxes) axes.resize(kMaxRevolutionAxes);
  return axes;
}

void add_cylinder_parts(Span<const Vec3> vertices, Span<const Face> faces, Span<const RevolutionAxis> axes,
                        std::vector<std::uint8_t>& parts) {
  if (axes.empty()) return;
  if (parts.empty()) parts.assign(faces.size(), 0);
  const std::vector<NeighbouringFaces> neighbours = neighbouring_faces(faces);
  std::size_t last = *std::max_element(parts.begin(), parts.end());
  std::vector<double> distances(faces.size());  // 0 for what is none of the axis' cylinders
  for (const RevolutionAxis& axis : axes) {
    const AxisFrame frame(axis.point, axis.direction);
    const auto triangle = [&](std::size_t f) {
      return Triangle{{vertices[faces[f].v[0]], vertices[faces[f].v[1]], vertices[faces[f].v[2]]}};
    };
    for (std::size_t f = 0; f < faces.size(); ++f)
      distances[f] = parts[f] == 0 ? cylinder_distance(frame, triangle(f)).value_or(0) : 0;
    ConnectedSets groups(faces.size());
    for (const NeighbouringFaces& n : neighbours) {
      const double x = distances[n.face[0]], y = distances[n.face[1]];
      if (x * y > 0 && std::abs(x - y) <= kOneDistance * std::abs(x))
        groups.join(std::min(n.face[0], n.face[1]), std::max(n.face[0], n.face[1]));
    }
    std::map<std::uint32_t, CylinderExtent> cylinders;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
      if (distances[f] == 0) continue;
      CylinderExtent& cylinder = cylinders[groups.set_of(f)];
      ++cylinder.count;
      cylinder.area += length(normal_unscaled(triangle(f))) / 2;
      cylinder.distance = std::abs(distances[f]);
      for (int i = 0; i < 3; ++i) {
        cylinder.begin = std::min(cylinder.begin, frame.along(triangle(f)[i]));
        cylinder.end = std::max(cylinder.end, frame.along(triangle(f)[i]));
      }
    }
    std::map<std::uint32_t, std::uint8_t> numbers;
    for (const auto& [group, cylinder] : cylinders)
      if (cylinder.count >= kMinOfCylinder && cylinder.turn() >= 2 * kQuarterTurn * 0.95 &&
          last < std::numeric_limits<std::uint8_t>::max())
        numbers[group] = static_cast<std::uint8_t>(++last);
    for (std::uint32_t f = 0; f < faces.size(); ++f)
      if (const auto number = distances[f] != 0 ? numbers.find(groups.set_of(f)) : numbers.end();
          number != numbers.end())
        parts[f] = number->second;
  }
}

}  // namespace dismantle
