// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/formats/gltf/write_glb.h"
#include "dismantle/session/timeline.h"

#include <vector>

namespace dismantle {

/// Order in which the moves of a path are carried out: as recorded (disassembly), or reversed (assembly).
enum class PathDirection { Forward, Reversed };

/// The animations of a timeline: "all" and "all, reversed", then "1 LABEL" and "1 LABEL, reversed" for each move.
/// Within each pair, the direction `first` comes first. In the animation of a move, the other components keep the poses
/// that they have at that time. Empty for a timeline without moves.
std::vector<GlbAnimation> path_animations(const Timeline& timeline, PathDirection first = PathDirection::Forward);

}  // namespace dismantle
