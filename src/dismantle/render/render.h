// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/render/camera.h"
#include "dismantle/render/image.h"
#include "dismantle/render/scene.h"

namespace dismantle {

/// Renders a scene: z-buffer, two-sided Phong shading with lights fixed to the camera, feature edges and outlines as
/// dark lines. Transparency by depth peeling of the nearest `transparent_layers` surfaces in front of the first opaque
/// one. Deterministic: the same pixels with every executor.
/// @pre width, height, samples, transparent_layers positive
Image render(const RenderScene& scene, const Camera& camera, const RenderOptions& options = {});

}  // namespace dismantle
