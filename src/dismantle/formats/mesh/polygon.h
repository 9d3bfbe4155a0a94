// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/geometry/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dismantle {

/// Triangulates polygons: strictly convex ones as a fan, others by ear clipping in the plane of the polygon's (Newell)
/// normal, without a corner in the middle of an edge if that can be avoided. A polygon of n corners gives n - 2
/// triangles, whatever its shape; if no ear is left (it intersects itself) the next corner is cut off. The work over
/// the object's lifetime is limited: beyond the limit, corners are cut off in order.
class PolygonTriangulator {
 public:
  /// Appends the triangles of one polygon to `faces`; one or two corners give one degenerate triangle.
  /// @pre every corner is below vertices.size(); at least one corner
  void append(Span<const std::uint32_t> corners, Span<const Vec3> vertices, std::vector<Face>& faces);

 private:
  struct Point {
    double x = 0, y = 0;
    friend bool operator==(const Point&, const Point&) = default;
  };

  static double turn(const Point& a, const Point& b, const Point& c);
  bool project(Span<const std::uint32_t> corners, Span<const Vec3> vertices);
  bool is_convex() const;
  bool is_ear(std::uint32_t corner);
  void clip(Span<const std::uint32_t> corners, std::vector<Face>& faces);

  std::vector<Point> points_;
  std::vector<std::uint32_t> previous_, next_;  // the ring of corners that are left
  std::size_t effort_left_ = 100'000'000;       // point-in-triangle tests: well under a second
};

}  // namespace dismantle
