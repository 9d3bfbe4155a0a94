// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/obb_fit.h"

#include "dismantle/bvh/surface_moments.h"
#include "dismantle/math/mat3.h"
#include "dismantle/math/vec3f.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dismantle {

namespace {

/// Two orthogonal unit directions; the third is their cross product.
struct Axes {
  Vec3 first, second;
};

Triangle triangle_of(Span<const Vec3> vertices, const Face& f) {
  return {{vertices[f.v[0]], vertices[f.v[1]], vertices[f.v[2]]}};
}

/// A unit vector perpendicular to the unit vector `n`.
Vec3 across(Vec3 n) {
  const Vec3 other = std::abs(n.x) <= std::abs(n.y) && std::abs(n.x) <= std::abs(n.z)
                         ? Vec3{1, 0, 0}
                         : (std::abs(n.y) <= std::abs(n.z) ? Vec3{0, 1, 0} : Vec3{0, 0, 1});
  return normalized(cross(n, other));
}

Axes axes_of_triangle(const Triangle& t) {
  Vec3 longest = t[1] - t[0];
  for (int i = 1; i < 3; ++i) {
    const Vec3 edge = t[(i + 1) % 3] - t[i];
    if (length_squared(edge) > length_squared(longest)) longest = edge;
  }
  const Vec3 first = normalized(longest);
  const Vec3 normal = normalized(normal_unscaled(t));
  if (length_squared(normal) == 0) return {first, across(first)};
  return {first, normalized(cross(normal, first))};
}

Mat3 covariance_of(Span<const Vec3> vertices, Span<const Face> faces, Span<const std::uint32_t> order) {
  const Vec3 about = vertices[faces[order[0]].v[0]];  // keeps digits far from the origin
  SurfaceMoments sum;
  for (const std::uint32_t f : order) {
    const Triangle t = triangle_of(vertices, faces[f]);
    sum += surface_moments({{t[0] - about, t[1] - about, t[2] - about}});
  }
  return surface_covariance(sum);
}

/// Turns rows p and q of both matrices so that a[p][q] becomes 0: one Jacobi rotation.
void jacobi_rotate(Mat3& a, Mat3& vectors, int p, int q) {
  const double apq = a.row[p][q];
  if (apq == 0) return;
  const double theta = (a.row[q][q] - a.row[p][p]) / (2 * apq);
  const double t = (theta >= 0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  for (int k = 0; k < 3; ++k) {
    const double akp = a.row[k][p], akq = a.row[k][q];
    a.row[k][p] = c * akp - s * akq;
    a.row[k][q] = s * akp + c * akq;
  }
  for (int k = 0; k < 3; ++k) {
    const double apk = a.row[p][k], aqk = a.row[q][k];
    a.row[p][k] = c * apk - s * aqk;
    a.row[q][k] = s * apk + c * aqk;
  }
  const Vec3 vp = vectors.row[p], vq = vectors.row[q];
  vectors.row[p] = c * vp - s * vq;
  vectors.row[q] = s * vp + c * vq;
}

/// Principal directions, the one of the largest moment first.
Axes principal_axes(Mat3 a) {
  constexpr int kSweeps = 8;  // converges quadratically; three do for nearly all
  Mat3 vectors;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    jacobi_rotate(a, vectors, 0, 1);
    jacobi_rotate(a, vectors, 0, 2);
    jacobi_rotate(a, vectors, 1, 2);
  }
  int order[3] = {0, 1, 2};
  std::sort(order, order + 3, [&](int i, int j) { return a.row[i][i] > a.row[j][j]; });
  const Vec3 first = normalized(vectors.row[order[0]]);
  Vec3 second = vectors.row[order[1]];
  second = normalized(second - dot(first, second) * first);
  return {first, length_squared(second) > 0.5 ? second : across(first)};
}

/// The rows that give the coordinates (t0, t1, t2) of x = t0 u0 + t1 u1 + t2 u2 for axes that are not quite orthogonal.
Mat3 dual_axes(const Obb& box) {
  const Vec3 u0 = to_double(box.axis[0]), u1 = to_double(box.axis[1]), u2 = to_double(box.third_axis());
  const double volume = dot(u0, cross(u1, u2));
  return {{cross(u1, u2) / volume, cross(u2, u0) / volume, cross(u0, u1) / volume}};
}

template <class Visit>
void for_each_vertex(Span<const Vec3> vertices, Span<const Face> faces, Span<const std::uint32_t> order, Visit visit) {
  for (const std::uint32_t f : order)
    for (const std::uint32_t v : faces[f].v) visit(vertices[v]);
}

/// Bounds the rounding of coordinates along the box's axes, relative to their size: some tens of double roundings.
constexpr double kCoordinateMargin = 0x1p-46;

}  // namespace

Obb obb_fit(Span<const Vec3> vertices, Span<const Face> faces, Span<const std::uint32_t> order, Vec3 origin) {
  const Axes axes = order.size() == 1 ? axes_of_triangle(triangle_of(vertices, faces[order[0]]))
                                      : principal_axes(covariance_of(vertices, faces, order));
  Obb box;
  box.axis[0] = to_float(axes.first);
  box.axis[1] = to_float(axes.second);
  return obb_fit_along(box, vertices, faces, order, origin);
}

Obb obb_fit_along(const Obb& like, Span<const Vec3> vertices, Span<const Face> faces, Span<const std::uint32_t> order,
                  Vec3 origin) {
  Obb box = like;
  const Mat3 dual = dual_axes(box);

  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3 lower{kInfinity, kInfinity, kInfinity}, upper{-kInfinity, -kInfinity, -kInfinity};
  double reach = 0;
  for_each_vertex(vertices, faces, order, [&](Vec3 x) {
    const Vec3 local = x - origin;
    const Vec3 t = dual * local;
    lower = min(lower, t);
    upper = max(upper, t);
    reach = std::max(reach, max_abs(local));
  });
  const Vec3 middle = 0.5 * (lower + upper);
  const Vec3 center =
      middle.x * to_double(box.axis[0]) + middle.y * to_double(box.axis[1]) + middle.z * to_double(box.third_axis());
  box.center = to_float(center);

  // The rounded center in the same coordinates; half lengths are the distances from it.
  const Vec3 c = dual * to_double(box.center);
  const Vec3 half = max(upper - c, c - lower);
  const double margin = kCoordinateMargin * (reach + max_abs(center));
  for (int i = 0; i < 3; ++i) box.half[i] = rounded_up(half[i] + margin);
  return box;
}

float obb_radius(const Obb& box) {
  // The axes are unit and orthogonal up to a few float roundings.
  constexpr double kAxesMargin = 1 + 0x1p-20;
  return rounded_up(length(to_double(box.half)) * kAxesMargin);
}

}  // namespace dismantle
