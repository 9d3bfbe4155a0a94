// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/render/camera.h"
#include "dismantle/render/scene.h"

#include <cstddef>
#include <vector>

namespace dismantle {

/// How much of each item a picture of that size shows: the pixels at whose middle it is in front of all other opaque
/// items. Nothing is drawn. Transparent and overlay items count nothing and hide nothing. Shape [item_count].
/// @pre width, height > 0
std::vector<std::size_t> visible_pixels(RenderScene scene, const Camera& camera, int width, int height);

}  // namespace dismantle
