// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/render/camera.h"
#include "dismantle/render/image.h"
#include "dismantle/render/scene.h"

namespace dismantle {

/// The picture of a scene: z-buffered, two-sided Phong shading under a light that goes with the camera, feature edges
/// and outlines as dark lines. Transparent items by depth peeling: the nearest `transparent_layers` surfaces in front
/// of the first opaque one. Same input, same pixels, for every executor.
/// @pre width, height, samples, transparent_layers positive
Image render(const RenderScene& scene, const Camera& camera, const RenderOptions& options = {});

}  // namespace dismantle
