// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/render/image.h"
#include "dismantle/render/project_scene.h"

namespace dismantle {

/// Light as it adds up: linear in intensity, unlike sRGB.
using LinearColor = Vec3f;

LinearColor linear_from_srgb(const Color& color);
Pixel srgb_from_linear(LinearColor color);

/// `color` over `below` with the given opacity.
inline LinearColor blended(LinearColor below, LinearColor color, float opacity) {
  return below + opacity * (color - below);
}

/// A point of a surface that a sample sees.
struct SurfacePoint {
  Vec3f normal;  ///< Unit, turned towards the eye; x right, y up, z towards the eye.
  Vec3f to_eye;  ///< Unit, same axes.
};

/// The surface that the sample's centre (x + 1/2, y + 1/2) sees on the triangle.
SurfacePoint surface_point(const ViewTransform& view, const ScreenTriangle& triangle, int x, int y);

/// Unit direction from what the sample sees to the eye; x right, y up, z towards the eye.
Vec3f direction_to_eye(const ViewTransform& view, int x, int y);

/// Light that comes off a surface of that colour: ambient, a key light from over the viewer's left shoulder, a fill
/// light from the right, and a highlight.
LinearColor shaded(LinearColor surface, const SurfacePoint& point);

/// How opaque a transparent surface looks: more so where it is seen at a flat angle, which shows its shape.
float apparent_opacity(float opacity, const SurfacePoint& point);

}  // namespace dismantle
