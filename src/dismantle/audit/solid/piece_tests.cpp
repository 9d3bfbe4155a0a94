// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/piece_tests.h"

#include "dismantle/audit/triangle_axes.h"
#include "dismantle/geometry/aabb.h"

#include <algorithm>
#include <cmath>

namespace dismantle::audit {

namespace {

/// The part of the real line that the projections of some points cover.
struct Shadow {
  double low = 0, high = 0;
};

/// True if two shadows on an axis are apart by more than `margin` times the length of the axis.
bool apart(const Shadow& p, const Shadow& q, Vec3 axis, double margin) {
  const double gap = std::max(p.low - q.high, q.low - p.high);
  return gap > 0 && gap * gap > margin * margin * dot(axis, axis);
}

Shadow shadow(const Triangle& t, Vec3 axis) {
  const double p0 = dot(t[0], axis), p1 = dot(t[1], axis), p2 = dot(t[2], axis);
  return {std::min({p0, p1, p2}), std::max({p0, p1, p2})};
}

/// The cross product of two edges as an axis of separation, of any length; of nearly parallel edges unit_cross().
Vec3 cross_axis(Vec3 a, Vec3 b) {
  const Vec3 c = cross(a, b);
  return dot(c, c) > kNearlyParallelSineSquared * dot(a, a) * dot(b, b) ? c : unit_cross(a, b);
}

/// An edge of the piece in the middle of its slice.
Vec3 middle_edge(const SurfacePiece& piece, int k) {
  const int next = (k + 1) % 3;
  return (piece.corner[next] - piece.corner[k]) + (piece.corner[next + 3] - piece.corner[k + 3]);
}

/// A shifted piece, for comparisons with many triangles.
class Hull {
 public:
  /// @param margin by which an axis has to separate the chords of the piece from a triangle
  Hull(const SurfacePiece& piece, Vec3 shift, double margin) : center_(piece.center + shift), margin_(margin) {
    for (int k = 0; k < 6; ++k) {
      const Vec3 p = piece.corner[k] + shift;
      box_.extend(p);
      x_[k] = p.x, y_[k] = p.y, z_[k] = p.z;
    }
    for (int k = 0; k < 3; ++k) edge_[k] = middle_edge(piece, k);
    own_axes_[0] = cross_axis(edge_[0], edge_[1]);
    for (int k = 0; k < 3; ++k) own_axes_[k + 1] = cross_axis(own_axes_[0], edge_[k]);
    for (int k = 0; k < 4; ++k) own_shadows_[k] = shadow(own_axes_[k]);
  }

  /// True if an axis separates the piece from a triangle: an axis of the frame, the normal of either, the direction
  /// between them, or a cross product of edges, also of those in the planes.
  bool clear_of(const Triangle& t) const {
    const Vec3 lower = min(min(t[0], t[1]), t[2]), upper = max(max(t[0], t[1]), t[2]);
    const Vec3 gap = max(box_.lower - upper, lower - box_.upper);
    if (std::max({gap.x, gap.y, gap.z}) > margin_) return true;
    const Vec3 sides[3] = {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
    const Vec3 normal = unit_normal(t);
    if (separated(t, normal) || separated(t, center_ - closest_point(t, center_))) return true;
    for (int k = 0; k < 4; ++k)
      if (apart(own_shadows_[k], audit::shadow(t, own_axes_[k]), own_axes_[k], margin_)) return true;
    for (const Vec3& side : sides) {
      for (const Vec3& edge : edge_)
        if (separated(t, cross_axis(edge, side))) return true;
      if (separated(t, cross_axis(normal, side))) return true;
    }
    return false;
  }

 private:
  Shadow shadow(Vec3 axis) const {
    double p[6];
    for (int k = 0; k < 6; ++k) p[k] = x_[k] * axis.x + y_[k] * axis.y + z_[k] * axis.z;
    return {std::min({p[0], p[1], p[2], p[3], p[4], p[5]}), std::max({p[0], p[1], p[2], p[3], p[4], p[5]})};
  }

  bool separated(const Triangle& t, Vec3 axis) const {
    return apart(shadow(axis), audit::shadow(t, axis), axis, margin_);
  }

  double x_[6], y_[6], z_[6];  // coordinates of the corners at both ends
  Aabb box_;
  Vec3 center_;
  Vec3 edge_[3];
  Vec3 own_axes_[4];  // the normal of the piece, and those of its edges in its plane
  Shadow own_shadows_[4];
  double margin_;
};

Vec3 closest_on_segment(Vec3 a, Vec3 b, Vec3 point) {
  const Vec3 edge = b - a;
  const double squared = dot(edge, edge);
  const double s = squared > 0 ? dot(point - a, edge) / squared : 0;
  return a + (s < 0 ? 0 : (s > 1 ? 1 : s)) * edge;
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
  return Hull(piece, shift, piece.deviation + margin).clear_of(t);
}

bool passes_clear(const SurfacePiece& piece, Vec3 shift, const AuditBody& body, Span<const std::uint32_t> faces,
                  double margin) {
  const Hull hull(piece, shift, piece.deviation + margin);
  return std::all_of(faces.begin(), faces.end(), [&](std::uint32_t f) { return hull.clear_of(body.triangle(f)); });
}

}  // namespace dismantle::audit
