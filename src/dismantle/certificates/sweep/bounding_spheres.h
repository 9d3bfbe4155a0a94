// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/sphere_tree.h"
#include "dismantle/core/id.h"
#include "dismantle/math/rigid_transform.h"

#include <vector>

namespace dismantle {

/// A sphere that moves.
struct SweptSphere {
  Vec3 from;             ///< Its center at the start [mm].
  Vec3 displacement;     ///< [mm]
  double radius = 0;     ///< [mm]
  double deviation = 0;  ///< Upper bound of the distance between arcs and chords of the motion [mm].

  /// Lower bound of the distance of the moving sphere from one at rest [mm]; negative if they may meet.
  double gap(const BoundingSphere& other) const;
  /// As gap() where `other` contains others: no larger than the result for any of them.
  double gap_to_any(const BoundingSphere& other) const;
};

/// Bounding spheres of the components of an assembly.
class BoundingSpheres {
 public:
  /// Adds the sphere of the next component. @param center, radius in the assembled state [mm]
  void add(Vec3 center, double radius) { spheres_.push_back({center, radius}); }

  /// Number of components.
  std::size_t size() const { return spheres_.size(); }
  /// The sphere of a component at a pose [mm, world].
  BoundingSphere at(ComponentId c, const Pose& pose) const;
  /// The sphere of a component that moves from `start` to `end`.
  SweptSphere swept(ComponentId moving, const RigidTransform& start, const RigidTransform& end, double deviation) const;
  /// Lower bound of the distance of two spheres while the one moves from `start` to `end` and the other is at
  /// `pose_fixed` [mm]; negative if they may meet.
  /// @param deviation upper bound of the distance between arcs and chords of the motion [mm]
  double gap(ComponentId moving, const RigidTransform& start, const RigidTransform& end, double deviation,
             ComponentId fixed, const Pose& pose_fixed) const {
    return swept(moving, start, end, deviation).gap(at(fixed, pose_fixed));
  }

 private:
  std::vector<BoundingSphere> spheres_;
};

}  // namespace dismantle
