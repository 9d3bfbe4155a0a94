// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/export/path_animations.h"

#include <vector>

namespace dismantle {

/// A set of components goes away from where it is, rigidly together.
struct RemovalMove {
  std::vector<ComponentId> components;
  /// From home to where it is put, each by one screw from the one before. At least one pose.
  std::vector<Pose> poses;
};

/// What a fitter does at a time: one removal, or several of equal components, one after another, along parallel ways.
struct WorkStep {
  std::vector<RemovalMove> removals;  ///< In the order of the path, whichever way it is gone.
  std::vector<Pose> before;           ///< Where every component is before the first of them. Shape [component_count].
};

/// The steps of a timeline in the order of `direction`; ways always lead away. Moves of one set that follow each other
/// are one removal.
std::vector<WorkStep> work_steps(const Assembly& assembly, const Timeline& timeline, PathDirection direction);

/// The components that stand to a removal's set as they are assembled with it, and of these the set's own are none:
/// what it is taken from. Where there are none, all others.
std::vector<ComponentId> surroundings(const WorkStep& step, const RemovalMove& removal);

/// A pose on a way.
struct PathPose {
  Pose pose;
  double distance = 0;  ///< That the middle of the set has gone [mm].
};

/// Places along a removal's way, close to each other at its beginning: the first is home, the last the end. A way cut
/// into many screws has all their ends.
/// @param middle of the assembled set [mm]
/// @param pieces that each screw is cut into, at least 1
std::vector<PathPose> poses_along(const RemovalMove& removal, const Vec3& middle, int pieces);

/// The box around a set at a pose [mm].
Aabb bounds_of(const Assembly& assembly, Span<const ComponentId> components, const Pose& pose = {});

}  // namespace dismantle
