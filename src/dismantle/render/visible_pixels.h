// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/render/camera.h"
#include "dismantle/render/scene.h"

#include <cstddef>
#include <vector>

namespace dismantle {

/// The number of pixels of each item in an image of the given size [pixels]: those at whose centre the item is the
/// nearest opaque one. Transparent and overlay items are ignored. Shape [item_count].
/// @pre width, height > 0
std::vector<std::size_t> visible_pixels(RenderScene scene, const Camera& camera, int width, int height);

}  // namespace dismantle
