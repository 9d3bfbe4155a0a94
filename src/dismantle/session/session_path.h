// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/path.h"
#include "dismantle/engine/motion_engine.h"

#include <string>
#include <vector>

namespace dismantle {

/// A path without moves: component names, tolerance, and the pairs that may be deeper than the tolerance: Overlapping
/// and Free ones.
Path empty_path(const Assembly& assembly, const PairStates& states);

/// The bounding box of a component at a pose [mm].
Aabb bounds_at(const Component& component, const Pose& pose);

/// The components outside the bounding box of the assembled assembly: `removed` in docs/formats.md.
std::vector<std::string> removed_components(const Assembly& assembly, Span<const Pose> poses);

/// Appends the frames of one step that ended at `time` [s]; its screw motions share its duration evenly. Appends none
/// if it did not move.
/// @pre frames is not empty; its last pose is the one before the step
void append_step_frames(std::vector<Frame>& frames, double time, const StepResult& step);

}  // namespace dismantle
