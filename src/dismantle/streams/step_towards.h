// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/path.h"
#include "dismantle/engine/chords.h"
#include "dismantle/engine/motion_engine.h"
#include "dismantle/streams/sweep_engine.h"

#include <vector>

namespace dismantle {

/// Components that move as one rigid body.
struct RigidSet {
  std::vector<ComponentId> components;  ///< The members of the set.
  Vec3 center;                          ///< Of a sphere around all their vertices [mm, assembled].
  double radius = 0;                    ///< Of that sphere [mm].
};

/// Makes the set of these components, with its bounding sphere.
RigidSet make_rigid_set(const Assembly& assembly, std::vector<ComponentId> components);

/// Moves the set from `start`, its pose in the engine's state, along the one screw towards `target`, as far as
/// `response` allows, and commits the engine to the resulting pose. Guarantee: the screw from `start` to that pose
/// satisfies the engine's guarantee, including the deviation of the true arcs. Stop: all the way or not at
/// all. Touch: up to the first contact.
/// @pre response is Stop or Touch; tolerance > 0 [mm]
StepResult step_towards(SweepEngine& engine, const RigidSet& set, const Pose& start, const Pose& target,
                        ResponseKind response, double tolerance);

}  // namespace dismantle
