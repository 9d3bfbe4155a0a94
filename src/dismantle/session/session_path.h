// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/path.h"
#include "dismantle/engine/motion_engine.h"

#include <string>
#include <vector>

namespace dismantle {

/// A path of no moves: the assembly's names, the tolerance, and the pairs that are allowed more than that.
Path empty_path(const Assembly& assembly, const PairStates& states);

/// The box around a component at a pose [mm].
Aabb bounds_at(const Component& component, const Pose& pose);

/// The components that stand outside the assembled assembly's bounding box: what docs/formats.md calls removed.
std::vector<std::string> removed_components(const Assembly& assembly, Span<const Pose> poses);

/// Adds the frames of one step that was made until `time`: the screws that it was cut into share its time evenly.
/// Adds none where it did not move.
/// @pre frames is not empty; its last pose is the one before the step
void append_way(std::vector<Frame>& frames, double time, const StepResult& step);

}  // namespace dismantle
