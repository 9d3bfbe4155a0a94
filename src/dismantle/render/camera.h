// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/geometry/aabb.h"
#include "dismantle/math/mat3.h"

#include <optional>
#include <string_view>

namespace dismantle {

enum class Projection { Orthographic, Perspective };

/// Where a picture is taken from. World frame, right-handed; pixels are square.
struct Camera {
  Vec3 eye{0, -1, 0};  ///< [mm]
  Vec3 target;         ///< Seen in the middle of the picture [mm].
  Vec3 up{0, 0, 1};    ///< Points up in the picture; must not be parallel to the line of sight.
  Projection projection = Projection::Orthographic;
  double height = 100;         ///< Orthographic: what the picture's height shows [mm].
  double field_of_view = 0.5;  ///< Perspective: over the picture's height [rad].
};

/// The standard views of mechanical drawings, z up: Front looks along +y, Right along -x, Top along -z.
enum class StandardView { Iso, Front, Back, Left, Right, Top, Bottom };

/// "iso", "front", "back", "left", "right", "top", "bottom"; nothing for any other word.
std::optional<StandardView> standard_view(std::string_view name);

/// The unit direction in which a standard view looks.
Vec3 view_direction(StandardView view);

/// How fit_camera places the camera.
struct CameraFit {
  Vec3 direction = view_direction(StandardView::Iso);  ///< In which the camera looks; any length but 0.
  Projection projection = Projection::Orthographic;
  double aspect = 4.0 / 3.0;  ///< Width of the picture by its height.
  double margin = 0.05;       ///< Empty border on each side, as a part of the picture.
};

/// A camera that sees all points, as near as the margin lets it; up is +z, or +y (-y) where it looks straight down
/// (up). Without any point it looks at the origin. @pre aspect > 0, 0 <= margin < 0.5
Camera fit_camera(Span<const Vec3> points, const CameraFit& fit = {});

/// The camera's axes by rows: right, up, forward. World frame, orthonormal.
Mat3 camera_axes(const Camera& camera);

}  // namespace dismantle
