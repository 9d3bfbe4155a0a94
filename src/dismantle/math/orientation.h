// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/orientation_exact.h"

namespace dismantle {

// Signs of orientation determinants, exact for every finite input: a floating-point filter with a proven bound decides
// nearly all cases, exact arithmetic the rest. Properties (tested):
//   1. The sign is that of the determinant of the coordinates as given, unaffected by rounding, overflow and underflow.
//   2. Exchanging two points negates the sign; a point in the plane (on the line) gives 0.

/// Relative error bound of the 2x2 determinant. With u = 2^-53: a term of the 2x2 determinant of rounded differences
/// passes 4 roundings (two differences, a product, the subtraction), so both terms together are off by less than 2 *
/// 4u(1 + 9u) X Y, with X and Y the largest absolute rounded differences. 8u, and room for the roundings of the bound
/// itself.
inline constexpr double kOrient2dError = 9 * 0x1p-53;

/// Relative error bound of the 3x3 determinant. As above: a term of the 3x3 determinant passes 8 roundings (three
/// differences, two products, the subtraction of the 2x2 minor, two additions), and two terms share a bound E_y E_z
/// |w_x|: 16u, and room for the bound's own roundings.
inline constexpr double kOrient3dError = 17 * 0x1p-53;

/// Bounds the loss by products that underflow: each loses at most 2^-1075, the minors' losses times a difference. Added
/// both to the bound of a minor and to that of the determinant.
inline constexpr double kOrientationUnderflow = 0x1p-1000;

/// The largest finite double. Infinite results are not trusted: a partial result may have overflowed.
inline constexpr double kLargestFinite = 0x1.fffffffffffffp+1023;

namespace detail {

/// The sign of `det` if it is certain, else 0. Without branches, which would be mispredicted half the time.
DISMANTLE_HOST_DEVICE inline int sure_sign(double det, double bound) {
  return static_cast<int>((det > bound) & (det <= kLargestFinite)) -
         static_cast<int>((det < -bound) & (det >= -kLargestFinite));
}

}  // namespace detail

/// The sign of (b - a) x (c - a): 1 if a, b, c turn counter-clockwise, 0 if they are on one line. Exact.
/// @pre all coordinates are finite
DISMANTLE_HOST_DEVICE inline int orient2d_sign(Vec2 a, Vec2 b, Vec2 c) {
  const Vec2 u{b.x - a.x, b.y - a.y}, v{c.x - a.x, c.y - a.y};
  const double det = u.x * v.y - u.y * v.x;
  const double x = max(detail::magnitude(u.x), detail::magnitude(v.x));
  const double y = max(detail::magnitude(u.y), detail::magnitude(v.y));
  const double bound = kOrient2dError * x * y + kOrientationUnderflow;
  const int sign = detail::sure_sign(det, bound);
  if (sign != 0) return sign;
  if (x == 0 || y == 0) return 0;
  return detail::orient2d_exact(a, b, c);
}

/// A plane through three points, prepared for side_of_plane.
struct OrientedPlane {
  Vec3 point[3];  ///< Counter-clockwise seen from the side that the normal points to.
  Vec3 normal;    ///< (point[1] - point[0]) x (point[2] - point[0]), rounded.
  Vec3 error;     ///< Error bound of the filter, per unit of a point's offset.
  Vec3 extent;    ///< Largest absolute coordinates of the two differences.
};

/// The plane through three points.
DISMANTLE_HOST_DEVICE inline OrientedPlane oriented_plane(Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 u = b - a, v = c - a;
  const Vec3 e = max(detail::magnitude(u), detail::magnitude(v));
  const double k = kOrient3dError, t = kOrientationUnderflow;
  return {{a, b, c}, cross(u, v), {k * (e.y * e.z) + t, k * (e.z * e.x) + t, k * (e.x * e.y) + t}, e};
}

/// The side of the plane that a point is on: 1 for the side that the normal points to, -1 for the other, 0 in the
/// plane; 0 for every point if the plane's three points are on one line. Exact. @pre all coordinates are finite
DISMANTLE_HOST_DEVICE inline int side_of_plane(const OrientedPlane& plane, Vec3 d) {
  const Vec3 w = d - plane.point[0];
  const double det = dot(plane.normal, w);
  const Vec3 size = detail::magnitude(w);
  const double bound = dot(plane.error, size) + kOrientationUnderflow;
  const int sign = detail::sure_sign(det, bound);
  if (sign != 0) return sign;
  // Points in one axis-aligned plane, the common case of contact in CAD models, need no exact arithmetic.
  const Vec3 extent = max(plane.extent, size);
  if (extent.x == 0 || extent.y == 0 || extent.z == 0) return 0;
  return detail::orient3d_exact(plane.point[0], plane.point[1], plane.point[2], d);
}

/// The sign of ((b - a) x (c - a)) . (d - a). Exact. @pre all coordinates are finite
DISMANTLE_HOST_DEVICE inline int orient3d_sign(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  return side_of_plane(oriented_plane(a, b, c), d);
}

}  // namespace dismantle
