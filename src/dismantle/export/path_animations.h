// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/formats/gltf/write_glb.h"
#include "dismantle/session/timeline.h"

#include <vector>

namespace dismantle {

/// Which way moves are gone: as they were recorded (apart), or from their end to their beginning (together).
enum class PathDirection { Forward, Reversed };

/// The animations of a timeline: "all" and "all, reversed", then "1 LABEL" and "1 LABEL, reversed" for each move; of
/// each two the one in `first` comes first. In a move's animation the other components stand where they are then.
/// Empty for a timeline without moves.
std::vector<GlbAnimation> path_animations(const Timeline& timeline, PathDirection first = PathDirection::Forward);

}  // namespace dismantle
