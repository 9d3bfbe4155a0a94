// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/render/image.h"
#include "dismantle/render/project_scene.h"

namespace dismantle {

/// A colour that is linear in intensity, unlike sRGB.
using LinearColor = Vec3f;

/// The linear colour of an sRGB colour; ignores `a`.
LinearColor linear_from_srgb(const Color& color);
/// The nearest sRGB pixel; channels are clamped to [0, 1].
Pixel srgb_from_linear(LinearColor color);

/// `color` over `below` with the given opacity.
inline LinearColor blended(LinearColor below, LinearColor color, float opacity) {
  return below + opacity * (color - below);
}

/// A surface point seen by a sample; axes: x right, y up, z towards the eye.
struct SurfacePoint {
  Vec3f normal;  ///< Unit length, on the side of the eye.
  Vec3f to_eye;  ///< Unit length.
};

/// The surface point of a triangle seen by the sample at (x + 1/2, y + 1/2).
SurfacePoint surface_point(const ViewTransform& view, const ScreenTriangle& triangle, int x, int y);

/// Unit direction from the surface seen by a sample to the eye; axes as in SurfacePoint.
Vec3f direction_to_eye(const ViewTransform& view, int x, int y);

/// Reflected light of a surface colour: ambient light, a key light over the viewer's left shoulder, a fill light from
/// the right, and a specular highlight of the key light.
LinearColor shaded(LinearColor surface, const SurfacePoint& point);

/// Opacity of a transparent surface, increased at grazing angles to show its shape.
float apparent_opacity(float opacity, const SurfacePoint& point);

}  // namespace dismantle
