// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/export/path_animations.h"
#include "dismantle/render/scene.h"

#include <cstddef>

namespace dismantle {

/// The scene of one move: all components in their poses before the move, the moving set highlighted, a ghost of it in
/// its final pose, and an arrow along the displacement of its centre. `step` counts from 0 in the given direction.
/// @pre step < timeline.moves().size()
RenderScene step_scene(const Assembly& assembly, const Timeline& timeline, std::size_t step,
                       PathDirection direction = PathDirection::Forward);

}  // namespace dismantle
