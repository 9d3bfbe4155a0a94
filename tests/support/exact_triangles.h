// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle.h"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>
#include <initializer_list>
#include <vector>

/// Triangle predicates in exact integers: the oracle for the floating-point predicates. Written from the
/// definitions (linear constraints, supports) and without the library's algorithms.
namespace dismantle::exact {

using Integer = boost::multiprecision::cpp_int;
using Real = boost::multiprecision::cpp_bin_float_50;

struct Point {
  Integer x, y, z;
};

inline Point operator+(const Point& p, const Point& q) {
  return {p.x + q.x, p.y + q.y, p.z + q.z};
}
inline Point operator-(const Point& p, const Point& q) {
  return {p.x - q.x, p.y - q.y, p.z - q.z};
}
inline Integer dot(const Point& p, const Point& q) {
  return p.x * q.x + p.y * q.y + p.z * q.z;
}
inline Point cross(const Point& p, const Point& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}
inline bool is_zero(const Point& p) {
  return p.x == 0 && p.y == 0 && p.z == 0;
}

using Corners = std::vector<Point>;  ///< Three of them.

/// The points in units of 2^unit, small enough that all are integers.
struct Scaled {
  std::vector<Point> points;
  int unit = 0;
};

inline int lowest_exponent(double x) {
  if (x == 0) return 1024;
  int e = 0;
  std::frexp(x, &e);
  return e - 53;
}

inline Integer integer_of(double x, int unit) {
  if (x == 0) return 0;
  int e = 0;
  const double fraction = std::frexp(x, &e);
  return Integer(static_cast<long long>(std::ldexp(fraction, 53))) << (e - 53 - unit);
}

inline Scaled scaled(std::initializer_list<Vec3> points) {
  Scaled s;
  s.unit = 1024;
  for (const Vec3& p : points)
    for (int k = 0; k < 3; ++k) s.unit = std::min(s.unit, lowest_exponent(p[k]));
  for (const Vec3& p : points)
    s.points.push_back({integer_of(p.x, s.unit), integer_of(p.y, s.unit), integer_of(p.z, s.unit)});
  return s;
}

inline int sign_of(const Integer& i) {
  return i.sign();
}

/// Sign of ((b - a) x (c - a)) . (d - a).
inline int orient3d_sign(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const std::vector<Point> p = scaled({a, b, c, d}).points;
  return sign_of(dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]));
}

/// The part of [0, 1] that satisfies linear constraints, its ends as fractions with positive denominators.
class ParameterInterval {
 public:
  /// Keeps the t with constant + slope * t >= 0.
  void keep_nonnegative(const Integer& constant, const Integer& slope) {
    if (slope == 0) {
      empty_ = empty_ || constant < 0;
    } else if (slope > 0) {
      if (-constant * lower_denominator_ > lower_ * slope) lower_ = -constant, lower_denominator_ = slope;
    } else {
      if (constant * upper_denominator_ < upper_ * -slope) upper_ = constant, upper_denominator_ = -slope;
    }
  }
  void keep_zero(const Integer& constant, const Integer& slope) {
    keep_nonnegative(constant, slope);
    keep_nonnegative(-constant, -slope);
  }
  bool empty() const { return empty_ || lower_ * upper_denominator_ > upper_ * lower_denominator_; }

 private:
  Integer lower_ = 0, lower_denominator_ = 1, upper_ = 1, upper_denominator_ = 1;
  bool empty_ = false;
};

/// True if the closed segment p-q meets the convex hull of three points, which may be a segment or a point.
inline bool segment_meets_hull(const Point& p, const Point& q, const Corners& t) {
  const Point along = q - p;
  ParameterInterval interval;
  const Point normal = cross(t[1] - t[0], t[2] - t[0]);
  if (!is_zero(normal)) {
    interval.keep_zero(dot(normal, p - t[0]), dot(normal, along));
    for (int i = 0; i < 3; ++i) {
      const Point inward = cross(normal, t[(i + 1) % 3] - t[i]);
      interval.keep_nonnegative(dot(inward, p - t[i]), dot(inward, along));
    }
    return !interval.empty();
  }
  int longest = 0;
  const auto edge = [&t](int i) { return t[(i + 1) % 3] - t[i]; };
  for (int i = 1; i < 3; ++i)
    if (dot(edge(i), edge(i)) > dot(edge(longest), edge(longest))) longest = i;
  const Point e = edge(longest), offset = p - t[longest];
  const Point off_line = cross(offset, e), off_line_slope = cross(along, e);
  interval.keep_zero(off_line.x, off_line_slope.x);
  interval.keep_zero(off_line.y, off_line_slope.y);
  interval.keep_zero(off_line.z, off_line_slope.z);
  interval.keep_nonnegative(dot(offset, e), dot(along, e));
  interval.keep_nonnegative(dot(e, e) - dot(offset, e), -dot(along, e));
  if (is_zero(e)) {
    interval.keep_zero(offset.x, along.x);
    interval.keep_zero(offset.y, along.y);
    interval.keep_zero(offset.z, along.z);
  }
  return !interval.empty();
}

/// True if two closed triangles meet: an edge of one meets the other.
inline bool triangles_meet(const Corners& a, const Corners& b) {
  for (int i = 0; i < 3; ++i)
    if (segment_meets_hull(a[i], a[(i + 1) % 3], b) || segment_meets_hull(b[i], b[(i + 1) % 3], a)) return true;
  return false;
}

/// True if all six corners are in one plane.
inline bool coplanar(const Corners& a, const Corners& b) {
  std::vector<Point> from_first;
  for (const Corners* t : {&a, &b})
    for (const Point& p : *t) from_first.push_back(p - a[0]);
  for (std::size_t i = 1; i < 6; ++i)
    for (std::size_t j = i + 1; j < 6; ++j)
      for (std::size_t k = j + 1; k < 6; ++k)
        if (dot(cross(from_first[i], from_first[j]), from_first[k]) != 0) return false;
  return true;
}

/// The minimum translation that separates triangles that meet, from the supports along the normals of the facets that
/// their Minkowski difference can have.
inline Real overlap(const Corners& a, const Corners& b, int unit) {
  std::vector<Point> axes = {cross(a[1] - a[0], a[2] - a[0]), cross(b[1] - b[0], b[2] - b[0])};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) axes.push_back(cross(a[(i + 1) % 3] - a[i], b[(j + 1) % 3] - b[j]));
  bool found = false;
  Integer minimum = 0, min_scale = 1;  // The squared depth is minimum / min_scale.
  for (const Point& n : axes) {
    if (is_zero(n)) continue;
    Integer a_lower = dot(n, a[0]), a_upper = a_lower, b_lower = dot(n, b[0]), b_upper = b_lower;
    for (int i = 1; i < 3; ++i) {
      const Integer of_a = dot(n, a[i]), of_b = dot(n, b[i]);
      if (of_a < a_lower) a_lower = of_a;
      if (of_a > a_upper) a_upper = of_a;
      if (of_b < b_lower) b_lower = of_b;
      if (of_b > b_upper) b_upper = of_b;
    }
    const Integer forward = a_upper - b_lower, backward = b_upper - a_lower;
    const Integer overlap = forward < backward ? forward : backward;
    const Integer square = overlap * overlap, scale = dot(n, n);
    if (!found || square * min_scale < minimum * scale) minimum = square, min_scale = scale;
    found = true;
  }
  return found ? ldexp(sqrt(Real(minimum) / Real(min_scale)), unit) : Real(0);
}

/// The minimum of fractions with positive denominators.
class MinFraction {
 public:
  void take(const Integer& numerator, const Integer& denominator) {
    if (found_ && numerator * denominator_ >= numerator_ * denominator) return;
    found_ = true, numerator_ = numerator, denominator_ = denominator;
  }
  Real value() const { return Real(numerator_) / Real(denominator_); }

 private:
  bool found_ = false;
  Integer numerator_ = 0, denominator_ = 1;
};

inline void take_point_segment(MinFraction& minimum, const Point& p, const Point& from, const Point& to) {
  const Point e = to - from, w = p - from;
  const Integer along = dot(w, e), squared = dot(e, e);
  if (along <= 0) return minimum.take(dot(w, w), 1);
  if (along >= squared) return minimum.take(dot(p - to, p - to), 1);
  const Point area = cross(w, e);
  minimum.take(dot(area, area), squared);
}

inline void take_point_face(MinFraction& minimum, const Point& p, const Corners& face) {
  const Point n = cross(face[1] - face[0], face[2] - face[0]);
  if (is_zero(n)) return;
  for (int i = 0; i < 3; ++i)
    if (dot(cross(n, face[(i + 1) % 3] - face[i]), p - face[i]) < 0) return;
  const Integer height = dot(n, p - face[0]);
  minimum.take(height * height, dot(n, n));
}

/// Takes the distance of the lines if their common normal meets both segments.
inline void take_lines(MinFraction& minimum, const Point& a0, const Point& a1, const Point& b0, const Point& b1) {
  const Point e = a1 - a0, f = b1 - b0, n = cross(e, f), w = b0 - a0;
  const Integer nn = dot(n, n), s = dot(cross(w, f), n), t = dot(cross(w, e), n);
  if (nn == 0 || s < 0 || s > nn || t < 0 || t > nn) return;
  const Integer height = dot(w, n);
  minimum.take(height * height, nn);
}

/// The distance of a point from a closed triangle.
inline Real point_distance(const Point& p, const Corners& face, int unit) {
  MinFraction minimum;
  take_point_face(minimum, p, face);
  for (int i = 0; i < 3; ++i) take_point_segment(minimum, p, face[i], face[(i + 1) % 3]);
  return ldexp(sqrt(minimum.value()), unit);
}

/// The distance of triangles that do not meet.
inline Real distance(const Corners& a, const Corners& b, int unit) {
  MinFraction minimum;
  for (int i = 0; i < 3; ++i) {
    take_point_face(minimum, a[i], b);
    take_point_face(minimum, b[i], a);
    for (int j = 0; j < 3; ++j) {
      take_point_segment(minimum, a[i], b[j], b[(j + 1) % 3]);
      take_point_segment(minimum, b[i], a[j], a[(j + 1) % 3]);
      take_lines(minimum, a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]);
    }
  }
  return ldexp(sqrt(minimum.value()), unit);
}

}  // namespace dismantle::exact
