// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/sweep/bounding_spheres.h"

#include <algorithm>

namespace dismantle {

void BoundingSpheres::add(Vec3 center, double radius) {
  centers_.push_back(center);
  radii_.push_back(radius);
}

double BoundingSpheres::gap(ComponentId moving, const RigidTransform& start, const RigidTransform& end,
                            double deviation, ComponentId fixed, const Pose& pose_fixed) const {
  const Vec3 from = start * centers_[moving.value], displacement = end * centers_[moving.value] - from;
  const Vec3 other =
      pose_fixed == Pose{} ? centers_[fixed.value] : transform_from_pose(pose_fixed) * centers_[fixed.value];
  const double length2 = length_squared(displacement);
  const double nearest = length2 > 0 ? std::clamp(dot(other - from, displacement) / length2, 0.0, 1.0) : 0;
  const double margin = 1e-9 * (max_abs(from) + max_abs(displacement) + max_abs(other));
  return length(from + nearest * displacement - other) - radii_[moving.value] - radii_[fixed.value] - deviation -
         margin;
}

}  // namespace dismantle
