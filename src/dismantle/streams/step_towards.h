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
  std::vector<ComponentId> components;
  Vec3 center;        ///< Of a sphere around all their assembled vertices [mm, assembled state].
  double radius = 0;  ///< [mm]
};

/// The set of these components with its bounding sphere.
RigidSet make_rigid_set(const Assembly& assembly, std::vector<ComponentId> components);

/// Moves the set from `start`, where the engine's state has it, along the one screw towards `target`, as far as
/// `response` allows. The engine's state is then the pose that is returned. Guarantee: the screw from `start` to the
/// returned pose holds the engine's guarantee, the deviation of the true arcs included. Stop: up to the last sweep that
/// was free as a whole. Touch: on to the first contact within the sweep that was not.
/// @pre response is Stop or Touch; tolerance > 0 [mm]
StepResult step_towards(SweepEngine& engine, const RigidSet& set, const Pose& start, const Pose& target,
                        ResponseKind response, double tolerance);

}  // namespace dismantle
