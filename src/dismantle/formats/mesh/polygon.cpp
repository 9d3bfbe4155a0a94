// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/mesh/polygon.h"

#include <cmath>

namespace dismantle {

namespace {

void append_fan(Span<const std::uint32_t> corners, std::vector<Face>& faces) {
  for (std::size_t i = 2; i < corners.size(); ++i) faces.push_back({{corners[0], corners[i - 1], corners[i]}});
}

/// Twice the polygon's area vector, about its first corner, for precision far from the origin.
Vec3 newell_normal(Span<const std::uint32_t> corners, Span<const Vec3> vertices) {
  const Vec3 origin = vertices[corners[0]];
  Vec3 normal;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    normal += cross(vertices[corners[i]] - origin, vertices[corners[i + 1]] - origin);
  return normal;
}

}  // namespace

double PolygonTriangulator::turn(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool PolygonTriangulator::project(Span<const std::uint32_t> corners, Span<const Vec3> vertices) {
  const Vec3 normal = newell_normal(corners, vertices);
  const double largest = max_abs(normal);
  if (!(largest > 0) || !std::isfinite(largest)) return false;

  // Drop the coordinate that the normal points along, so that the projection runs counter-clockwise.
  const int drop = std::abs(normal.x) == largest ? 0 : (std::abs(normal.y) == largest ? 1 : 2);
  const bool mirrored = normal[drop] < 0;
  const int u = (drop + (mirrored ? 2 : 1)) % 3, v = (drop + (mirrored ? 1 : 2)) % 3;
  points_.clear();
  for (const std::uint32_t corner : corners) points_.push_back({vertices[corner][u], vertices[corner][v]});
  return true;
}

bool PolygonTriangulator::is_convex() const {
  const std::size_t n = points_.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (!(turn(points_[i], points_[(i + 1) % n], points_[(i + 2) % n]) > 0)) return false;
    // A star polygon also turns left everywhere, but not as seen from one of its corners.
    if (i > 1 && !(turn(points_[0], points_[i - 1], points_[i]) > 0)) return false;
  }
  return true;
}

bool PolygonTriangulator::is_ear(std::uint32_t corner) {
  if (effort_left_ > 0) --effort_left_;
  const std::uint32_t before = previous_[corner], after = next_[corner];
  const Point a = points_[before], b = points_[corner], c = points_[after];
  if (!(turn(a, b, c) > 0)) return false;
  for (std::uint32_t i = next_[after]; i != before; i = next_[i]) {
    if (effort_left_ > 0) --effort_left_;
    const Point p = points_[i];
    if (p == a || p == b || p == c) continue;
    if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
  }
  return true;
}

void PolygonTriangulator::clip(Span<const std::uint32_t> corners, std::vector<Face>& faces) {
  const auto n = static_cast<std::uint32_t>(corners.size());
  previous_.resize(n);
  next_.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    previous_[i] = (i + n - 1) % n;
    next_[i] = (i + 1) % n;
  }

  std::uint32_t at = 0, left = n, refused = 0;
  while (left > 3) {
    // No ear in a full pass: the polygon is not simple, so any corner is cut.
    if (refused < left && effort_left_ > 0 && !is_ear(at)) {
      ++refused;
      at = next_[at];
      continue;
    }
    const std::uint32_t before = previous_[at], after = next_[at];
    faces.push_back({{corners[before], corners[at], corners[after]}});
    next_[before] = after;
    previous_[after] = before;
    at = next_[after];
    --left;
    refused = 0;
  }
  faces.push_back({{corners[previous_[at]], corners[at], corners[next_[at]]}});
}

void PolygonTriangulator::append(Span<const std::uint32_t> corners, Span<const Vec3> vertices,
                                 std::vector<Face>& faces) {
  if (corners.size() < 3) {
    faces.push_back({{corners[0], corners[corners.size() - 1], corners[0]}});
  } else if (corners.size() == 3) {
    faces.push_back({{corners[0], corners[1], corners[2]}});
  } else if (!project(corners, vertices) || is_convex()) {
    append_fan(corners, faces);
  } else {
    clip(corners, faces);
  }
}

}  // namespace dismantle
