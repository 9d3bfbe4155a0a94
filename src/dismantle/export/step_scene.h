// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/export/path_animations.h"
#include "dismantle/render/scene.h"

#include <cstddef>

namespace dismantle {

/// What a picture of one move shows: everything where it is before the move, what moves in a colour of its own, where
/// it goes as a ghost, and an arrow along the way of its middle. `step` counts from 0 in the direction.
/// @pre step < timeline.moves().size()
RenderScene step_scene(const Assembly& assembly, const Timeline& timeline, std::size_t step,
                       PathDirection direction = PathDirection::Forward);

}  // namespace dismantle
