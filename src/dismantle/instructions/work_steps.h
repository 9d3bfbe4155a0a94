// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/export/path_animations.h"

#include <vector>

namespace dismantle {

/// The removal of a set of components as one rigid body.
struct RemovalMove {
  std::vector<ComponentId> components;  ///< The moving set.
  /// From the initial to the final pose, joined by screw motions. At least one.
  std::vector<Pose> poses;
};

/// One step of the work instructions: one removal, or several removals of equal components, or sets of
/// them, along parallel paths.
struct WorkStep {
  std::vector<RemovalMove> removals;  ///< In the order of disassembly, also for assembly.
  std::vector<Pose> before;           ///< Poses of all components before the first removal. Shape [component_count].
};

/// Groups the moves of a timeline into steps, in the order of `direction`. Removals always lead away from the assembled
/// state. Consecutive moves of one set are one removal.
std::vector<WorkStep> work_steps(const Assembly& assembly, const Timeline& timeline, PathDirection direction);

/// The surroundings of a removal: the components outside the moving set that are in their assembled pose relative to
/// it; all other components if there are none.
std::vector<ComponentId> surroundings(const WorkStep& step, const RemovalMove& removal);

/// A pose on a removal path.
struct PathPose {
  Pose pose;            ///< Of the moving set.
  double distance = 0;  ///< Path length of the centre of the set up to here [mm].
};

/// Samples a removal path, more densely at its beginning. Contains the first pose, the last one, and the end of every
/// screw motion.
/// @param center of the assembled set [mm]
/// @param samples per screw motion, at least 1
std::vector<PathPose> poses_along(const RemovalMove& removal, const Vec3& center, int samples);

/// Bounding box of a set at a pose [mm].
Aabb bounds_of(const Assembly& assembly, Span<const ComponentId> components, const Pose& pose = {});

}  // namespace dismantle
