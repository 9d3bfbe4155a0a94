// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/piece_tests.h"

#include "dismantle/audit/triangle_axes.h"

#include <cmath>

namespace dismantle::audit {

namespace {

/// The points of a piece, shifted, and a margin by which they have to be separated.
struct Hull {
  Vec3 points[6];
  double margin = 0;

  /// True if the axis, in either direction, separates the hull from the triangle by more than the margin.
  bool separated(const Triangle& t, Vec3 axis) const {
    double low = dot(points[0], axis), high = low;
    for (int k = 1; k < 6; ++k) {
      const double p = dot(points[k], axis);
      low = p < low ? p : low;
      high = p > high ? p : high;
    }
    return low - highest(t, axis) > margin || lowest(t, axis) - high > margin;
  }
};

Vec3 closest_on_segment(Vec3 a, Vec3 b, Vec3 point) {
  const Vec3 edge = b - a;
  const double squared = dot(edge, edge);
  const double s = squared > 0 ? dot(point - a, edge) / squared : 0;
  return a + (s < 0 ? 0 : (s > 1 ? 1 : s)) * edge;
}

/// An edge of the piece in the middle of its slice.
Vec3 middle_edge(const SurfacePiece& piece, int k) {
  const int next = (k + 1) % 3;
  return (piece.corner[next] - piece.corner[k]) + (piece.corner[next + 3] - piece.corner[k + 3]);
}

}  // namespace

Vec3 closest_point(const Triangle& t, Vec3 point) {
  const Vec3 normal = normal_unscaled(t);
  const double squared = dot(normal, normal);
  if (squared > 0) {
    bool above = true;
    for (int k = 0; k < 3 && above; ++k) above = dot(cross(normal, t[(k + 1) % 3] - t[k]), point - t[k]) >= 0;
    if (above) return point - (dot(normal, point - t[0]) / squared) * normal;
  }
  Vec3 best = closest_on_segment(t[0], t[1], point);
  for (int k = 1; k < 3; ++k) {
    const Vec3 p = closest_on_segment(t[k], t[(k + 1) % 3], point);
    if (length_squared(p - point) < length_squared(best - point)) best = p;
  }
  return best;
}

bool stays_within(const SurfacePiece& piece, const Triangle& t, double limit) {
  for (const Vec3& p : piece.corner)
    if (!(distance_to_triangle(t, p) + piece.deviation <= limit)) return false;
  return true;
}

bool stays_within_either(const SurfacePiece& piece, const Triangle& s, const Triangle& t, double limit) {
  Vec3 up_s = unit_normal(s), up_t = unit_normal(t);
  if (dot(up_s, piece.center - s[0]) < 0) up_s = -up_s;
  if (dot(up_t, piece.center - t[0]) < 0) up_t = -up_t;
  const double most = limit - piece.deviation;
  // Above 0 where a point is higher over the plane of s.
  double height[6];
  for (int k = 0; k < 6; ++k) {
    const Vec3 p = piece.corner[k];
    height[k] = dot(up_s, p - s[0]) - dot(up_t, p - t[0]);
    if (!(distance_to_triangle(height[k] > 0 ? t : s, p) <= most)) return false;
  }
  // The corners of the cut are on the way from a corner on one side to a corner on the other.
  for (int j = 0; j < 6; ++j)
    for (int k = 0; k < 6; ++k) {
      if (!(height[j] > 0) || height[k] > 0) continue;
      const double way = height[j] / (height[j] - height[k]);
      const Vec3 cut = (1 - way) * piece.corner[j] + way * piece.corner[k];
      if (!(distance_to_triangle(s, cut) <= most) || !(distance_to_triangle(t, cut) <= most)) return false;
    }
  return true;
}

bool passes_clear(const SurfacePiece& piece, Vec3 shift, const Triangle& t, double margin) {
  Hull hull;
  for (int k = 0; k < 6; ++k) hull.points[k] = piece.corner[k] + shift;
  hull.margin = piece.deviation + margin;
  const Vec3 normal = unit_normal(t);
  if (hull.separated(t, normal)) return true;
  const Vec3 center = piece.center + shift;
  if (hull.separated(t, normalized(center - closest_point(t, center)))) return true;
  const Vec3 edge[3] = {middle_edge(piece, 0), middle_edge(piece, 1), middle_edge(piece, 2)};
  const Vec3 own = unit_cross(edge[0], edge[1]);
  if (hull.separated(t, own)) return true;
  for (int k = 0; k < 3; ++k) {
    const Vec3 other = t[(k + 1) % 3] - t[k];
    for (const Vec3& e : edge)
      if (hull.separated(t, unit_cross(e, other))) return true;
    if (hull.separated(t, unit_cross(normal, other)) || hull.separated(t, unit_cross(own, edge[k]))) return true;
  }
  return false;
}

bool passes_clear(const SurfacePiece& piece, Vec3 shift, const AuditBody& body, Span<const std::uint32_t> faces,
                  double margin) {
  for (const std::uint32_t f : faces)
    if (!passes_clear(piece, shift, body.triangle(f), margin)) return false;
  return true;
}

}  // namespace dismantle::audit
