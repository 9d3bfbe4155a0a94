// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle.h"
#include "dismantle/math/mat3.h"

namespace dismantle {

/// Zeroth to second moments of a surface about the origin (Gottschalk, Lin, Manocha 1996), all of them doubled. The
/// moments of a united surface are the sums of those of its parts.
struct SurfaceMoments {
  double area = 0;  ///< Twice the area [mm^2]; above 0 also for a degenerate triangle.
  Vec3 first;       ///< x, y, z [mm^3]
  Vec3 square;      ///< xx, yy, zz [mm^4]
  Vec3 mixed;       ///< yz, zx, xy [mm^4]

  /// Adds a part of the surface.
  SurfaceMoments& operator+=(const SurfaceMoments& other) {
    area += other.area;
    first += other.first;
    square += other.square;
    mixed += other.mixed;
    return *this;
  }
  /// The moments of `a` without its part `b`.
  friend SurfaceMoments operator-(SurfaceMoments a, const SurfaceMoments& b) {
    return {a.area - b.area, a.first - b.first, a.square - b.square, a.mixed - b.mixed};
  }
};

/// The moments of one triangle.
SurfaceMoments surface_moments(const Triangle& triangle);

/// The symmetric matrix of second moments about the centroid, divided by the area [mm^2]. @pre m.area > 0
Mat3 surface_covariance(const SurfaceMoments& m);

/// An estimate of the volume that the surface takes [mm^3]: the product of its standard deviations along its principal
/// axes, each widened by `floor` [mm].
double surface_volume(const SurfaceMoments& m, double floor);

}  // namespace dismantle
