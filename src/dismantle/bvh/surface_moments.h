// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle.h"
#include "dismantle/math/mat3.h"

namespace dismantle {

/// Zeroth to second moments of a surface about the origin of its coordinates (Gottschalk, Lin, Manocha 1996). Sums of
/// moments are those of the united surface.
struct SurfaceMoments {
  double area = 0;  ///< Twice the area [mm^2]; a triangle without any counts as a point of next to nothing.
  Vec3 first;
  Vec3 square;  ///< xx, yy, zz
  Vec3 mixed;   ///< yz, zx, xy

  SurfaceMoments& operator+=(const SurfaceMoments& other) {
    area += other.area;
    first += other.first;
    square += other.square;
    mixed += other.mixed;
    return *this;
  }
  friend SurfaceMoments operator-(SurfaceMoments a, const SurfaceMoments& b) {
    return {a.area - b.area, a.first - b.first, a.square - b.square, a.mixed - b.mixed};
  }
};

SurfaceMoments surface_moments(const Triangle& triangle);

/// The symmetric second-moment matrix about the centroid, over the area [mm^2]. @pre m.area > 0
Mat3 surface_covariance(const SurfaceMoments& m);

/// How much room the surface takes [mm^3]: the product of its standard deviations along its principal axes, each
/// widened by `floor` [mm]; an estimate.
double surface_volume(const SurfaceMoments& m, double floor);

}  // namespace dismantle
