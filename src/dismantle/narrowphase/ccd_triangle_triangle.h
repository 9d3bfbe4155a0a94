// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/contract.h"
#include "dismantle/narrowphase/closest_points.h"
#include "dismantle/narrowphase/conservative_advancement.h"

namespace dismantle {

namespace detail {

/// Two triangles for conservative_advancement(). Positions are relative to the first corner of A at the same time.
class TrianglePair {
 public:
  using Axes = FurthestAxis<3, 3>;  ///< The axes tried.

  /// @param allowed penetration that is allowed [mm], >= 0
  DISMANTLE_HOST_DEVICE TrianglePair(const TriangleMotion& a, const TriangleMotion& b, double allowed)
      : hulls_(a.t0.corner, a.t1.corner, b.t0.corner, b.t1.corner), allowed_(allowed) {}

  /// The triangles' relative motion.
  DISMANTLE_HOST_DEVICE const RelativeHulls<3, 3>& hulls() const { return hulls_; }

  /// Tries the caller's axis and the faces' normals, which decide most pairs that slide or rest on each other.
  DISMANTLE_HOST_DEVICE bool start(Axes& best) const {
    if (length_squared(best.axis()) > 0) best.consider(best.axis());
    if (best.end() >= 1) return true;
    const Triangles now = triangles_at(0);
    best.consider_both_signs(normal_unscaled(now.a));
    if (best.end() >= 1) return true;
    best.consider_both_signs(normal_unscaled(now.b));
    return best.end() >= 1;
  }

  /// The axis between the closest of the 6 vertex-face and 9 edge-edge pairs; useless where the triangles intersect.
  DISMANTLE_HOST_DEVICE AxisGuess guess(double t) const {
    const Triangles now = triangles_at(t);
    Nearest nearest(now, closest_points_vertex_face(now.a[0], now.b).point_b - now.a[0]);
    for (int i = 1; i < 3; ++i)
      if (nearest.beaten_by(nearest.b.low(), nearest.a.at[i]))
        nearest.take(now, closest_points_vertex_face(now.a[i], now.b).point_b - now.a[i]);
    for (int j = 0; j < 3; ++j)
      if (nearest.beaten_by(nearest.b.at[j], nearest.a.high()))
        nearest.take(now, now.b[j] - closest_points_vertex_face(now.b[j], now.a).point_b);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int next_i = (i + 1) % 3, next_j = (j + 1) % 3;
        if (!nearest.beaten_by(nearest.b.low(j, next_j), nearest.a.high(i, next_i))) continue;
        const ClosestPoints c = closest_points_edge_edge({now.a[i], now.a[next_i]}, {now.b[j], now.b[next_j]});
        nearest.take(now, c.point_b - c.point_a);
      }
    return {nearest.between, false};
  }

  /// No other certificate than axes.
  DISMANTLE_HOST_DEVICE double advance(double t) const { return t; }

  /// Tries the axis at the time of contact that follows from the last two steps' axes and gaps by linear extrapolation.
  /// Newton's method alone stalls where the best axis turns while the hulls approach each other.
  DISMANTLE_HOST_DEVICE void extrapolate(Axes& best, double t) {
    const Step now = step_at(best.axis(), t);
    if (best.end() > t && now.time > last_.time && last_.gap > now.gap) {
      const double run = now.time - last_.time;
      const double ahead = now.gap * run / (last_.gap - now.gap);
      const double rest = 1 - t;
      best.consider(now.axis + ((ahead < rest ? ahead : rest) / run) * (now.axis - last_.axis));
    }
    last_ = now;
  }

  /// Tries the 17 axes of which one separates any two triangles that are apart (and 11 of which give their depth): 2
  /// face normals, 9 cross products of edges, 6 normals of edges within a face's plane; for triangles without area also
  /// the normals of their edges.
  DISMANTLE_HOST_DEVICE void consider_all(Axes& best, double t) const {
    const Triangles now = triangles_at(t);
    const Vec3 normal_a = normal_unscaled(now.a), normal_b = normal_unscaled(now.b);
    consider_if_apart(best, now, normal_a);
    consider_if_apart(best, now, normal_b);
    for (int i = 0; i < 3; ++i) {
      const Vec3 along_a = now.a[(i + 1) % 3] - now.a[i], along_b = now.b[(i + 1) % 3] - now.b[i];
      consider_if_apart(best, now, cross(along_a, normal_a));
      consider_if_apart(best, now, cross(along_b, normal_b));
      for (int j = 0; j < 3; ++j) consider_if_apart(best, now, cross(along_a, now.b[(j + 1) % 3] - now.b[j]));
    }
    if (best.end() >= t + kMinProgress) return;
    for (int i = 0; i < 3; ++i) {
      consider_if_apart(best, now, some_normal(now.a[(i + 1) % 3] - now.a[i]));
      consider_if_apart(best, now, some_normal(now.b[(i + 1) % 3] - now.b[i]));
    }
  }

 private:
  struct Triangles {
    Triangle a, b;
  };
  /// The projections of a triangle's corners on an axis.
  struct Projection {
    double at[3];

    DISMANTLE_HOST_DEVICE Projection(const Triangle& t, Vec3 w) : at{dot(w, t[0]), dot(w, t[1]), dot(w, t[2])} {}
    DISMANTLE_HOST_DEVICE double low(int i, int j) const { return at[i] < at[j] ? at[i] : at[j]; }
    DISMANTLE_HOST_DEVICE double high(int i, int j) const { return at[i] < at[j] ? at[j] : at[i]; }
    DISMANTLE_HOST_DEVICE double low() const { return low(0, 1) < at[2] ? low(0, 1) : at[2]; }
    DISMANTLE_HOST_DEVICE double high() const { return high(0, 1) > at[2] ? high(0, 1) : at[2]; }
  };
  /// The shortest vector found between two features, from A to B, and the projections of the corners on it, which tell
  /// which other features cannot be nearer.
  struct Nearest {
    Vec3 between;
    double square;
    Projection a, b;

    DISMANTLE_HOST_DEVICE Nearest(const Triangles& now, Vec3 w)
        : between(w), square(length_squared(w)), a(now.a, w), b(now.b, w) {}
    DISMANTLE_HOST_DEVICE bool beaten_by(double low_b, double high_a) const {
      return low_b - high_a < (1 - kGuessRounding) * square;
    }
    DISMANTLE_HOST_DEVICE void take(const Triangles& now, Vec3 w) {
      if (length_squared(w) < square) *this = Nearest(now, w);
    }
  };
  /// More than the relative rounding of projections that only decide which axes are tried.
  static constexpr double kGuessRounding = 0x1p-30;

  /// The unit axis of a step, and the gap along it plus the allowance.
  struct Step {
    double time = -1, gap = 0;
    Vec3 axis;
  };

  DISMANTLE_HOST_DEVICE Triangles triangles_at(double t) const {
    Triangles now;
    for (int i = 1; i < 3; ++i) now.a[i] = (1 - t) * hulls_.a[0][i] + t * hulls_.a[1][i];
    for (int j = 0; j < 3; ++j) now.b[j] = (1 - t) * hulls_.b[0][j] + t * hulls_.b[1][j];
    return now;
  }

  /// Tries an axis unless the triangles clearly overlap along it in both directions, as along most axes at a contact.
  DISMANTLE_HOST_DEVICE void consider_if_apart(Axes& best, const Triangles& now, Vec3 w) const {
    const Projection a(now.a, w), b(now.b, w);
    const double forth = b.low() - a.high(), back = a.low() - b.high();
    const double slack = allowed_ > 0 ? allowed_ * norm_one(w) : 0;
    const double rounding = kGuessRounding * ((a.high() - a.low()) + (b.high() - b.low()));
    if ((forth > back ? forth : back) + slack >= -rounding) best.consider_both_signs(w);
  }

  /// A direction perpendicular to `along`: its cross product with the coordinate axis of its smallest coordinate.
  DISMANTLE_HOST_DEVICE static Vec3 some_normal(Vec3 along) {
    const Vec3 size = absolute(along);
    if (size.x <= size.y && size.x <= size.z) return {0, along.z, -along.y};
    if (size.y <= size.z) return {-along.z, 0, along.x};
    return {along.y, -along.x, 0};
  }

  DISMANTLE_HOST_DEVICE Step step_at(Vec3 w, double t) const {
    const Triangles now = triangles_at(t);
    const Vec3 unit = normalized(w);
    double min_b = dot(unit, now.b[0]), max_a = dot(unit, now.a[0]);
    for (int i = 1; i < 3; ++i) {
      const double b = dot(unit, now.b[i]), a = dot(unit, now.a[i]);
      min_b = b < min_b ? b : min_b;
      max_a = a > max_a ? a : max_a;
    }
    return {t, min_b - max_a + allowed_, unit};
  }

  RelativeHulls<3, 3> hulls_;
  double allowed_;
  Step last_;
};

}  // namespace detail

/// As ccd_triangle_triangle(a, b, allowed), but tries `hint` first (from a to b, any length; zero for none) and returns
/// the last axis, the hint for the pair's next motion. A hint that has used part of the allowance at the start is only
/// left for an axis within a right angle of it, so that faces of open sheets, which have no thickness, do not pass
/// through each other from one motion to the next.
DISMANTLE_HOST_DEVICE inline AxisCcdResult ccd_triangle_triangle(const TriangleMotion& a, const TriangleMotion& b,
                                                                 double allowed, Vec3 hint,
                                                                 const AdvancementLimits& limits = {}) {
  DISMANTLE_EXPECT(allowed >= 0);
  detail::TrianglePair pair(a, b, allowed);
  return conservative_advancement(pair, detail::TrianglePair::Axes(pair.hulls(), allowed, hint), limits);
}

/// The certified continuous test of a triangle pair with linear vertex paths: conservative advancement along separating
/// axes. The depth of two triangles is the length of the shortest translation that separates them, 0 where they are
/// apart.
///   1. Free is certain: at no time is the depth above `allowed`, despite rounding.
///   2. Contact: the depth is certainly at most `allowed` on [0, toi]; toi is 0 where it is above at the start.
///   3. With allowed = 0, touching counts as contact (closed sets).
/// No false negative by proof: docs/design/0001-certified-ccd.md.
///
/// At toi the depth is `allowed`, often to the last bit. Positions that are rounded again there may be too deep, and
/// then every further motion is Contact at 0: a caller that goes on from a contact stops a little earlier (a millionth
/// of the motion suffices).
/// @param allowed penetration that is allowed [mm], >= 0
DISMANTLE_HOST_DEVICE inline CcdResult ccd_triangle_triangle(const TriangleMotion& a, const TriangleMotion& b,
                                                             double allowed) {
  return ccd_triangle_triangle(a, b, allowed, Vec3{}).ccd;
}

}  // namespace dismantle
