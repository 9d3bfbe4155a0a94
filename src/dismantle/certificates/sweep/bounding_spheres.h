// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/id.h"
#include "dismantle/math/rigid_transform.h"

#include <vector>

namespace dismantle {

/// Bounding spheres of the components of an assembly.
class BoundingSpheres {
 public:
  /// Adds the sphere of the next component. @param center, radius in the assembled state [mm]
  void add(Vec3 center, double radius);

  /// Lower bound of the distance of two spheres while the one moves from `start` to `end` and the other is at
  /// `pose_fixed` [mm]; negative if they may meet.
  /// @param deviation upper bound of the distance between arcs and chords of the motion [mm]
  double gap(ComponentId moving, const RigidTransform& start, const RigidTransform& end, double deviation,
             ComponentId fixed, const Pose& pose_fixed) const;

 private:
  std::vector<Vec3> centers_;
  std::vector<double> radii_;
};

}  // namespace dismantle
