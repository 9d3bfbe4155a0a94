// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/sweep/bounding_spheres.h"

#include <algorithm>

namespace dismantle {

namespace {

/// Bounds the rounding of a gap, relative to the coordinates.
constexpr double kRounding = 1e-9;

}  // namespace

double SweptSphere::gap(const BoundingSphere& other) const {
  const double length2 = length_squared(displacement);
  const double nearest = length2 > 0 ? std::clamp(dot(other.center - from, displacement) / length2, 0.0, 1.0) : 0;
  const double margin = kRounding * (max_abs(from) + max_abs(displacement) + max_abs(other.center));
  return length(from + nearest * displacement - other.center) - radius - other.radius - deviation - margin;
}

double SweptSphere::gap_to_any(const BoundingSphere& other) const {
  // The margins of what is inside depend on their centers.
  return gap(other) - kRounding * (max_abs(from) + max_abs(displacement) + max_abs(other.center) + 2 * other.radius);
}

BoundingSphere BoundingSpheres::at(ComponentId c, const Pose& pose) const {
  BoundingSphere sphere = spheres_[c.value];
  if (!(pose == Pose{})) sphere.center = transform_from_pose(pose) * sphere.center;
  return sphere;
}

SweptSphere BoundingSpheres::swept(ComponentId moving, const RigidTransform& start, const RigidTransform& end,
                                   double deviation) const {
  const Vec3 from = start * spheres_[moving.value].center;
  return {from, end * spheres_[moving.value].center - from, spheres_[moving.value].radius, deviation};
}

}  // namespace dismantle
