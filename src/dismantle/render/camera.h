// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/geometry/aabb.h"
#include "dismantle/math/mat3.h"

#include <optional>
#include <string_view>

namespace dismantle {

/// The projection of a camera.
enum class Projection { Orthographic, Perspective };

/// The viewpoint of a picture. World frame, right-handed; pixels are square.
struct Camera {
  Vec3 eye{0, -1, 0};  ///< [mm]
  Vec3 target;         ///< Point at the centre of the picture [mm].
  Vec3 up{0, 0, 1};    ///< Direction that points up in the picture; must not be parallel to the line of sight.
  Projection projection = Projection::Orthographic;  ///< Selects which of the two sizes below applies.
  double height = 100;                               ///< Orthographic: extent over the picture's height [mm].
  double field_of_view = 0.5;                        ///< Perspective: angle over the picture's height [rad].
};

/// The standard views of mechanical drawings, z up: Front looks along +y, Right along -x, Top along -z.
enum class StandardView { Iso, Front, Back, Left, Right, Top, Bottom };

/// The standard view named "iso", "front", "back", "left", "right", "top" or "bottom"; nothing for any other name.
std::optional<StandardView> standard_view(std::string_view name);

/// The viewing direction of a standard view; unit length.
Vec3 view_direction(StandardView view);

/// Options of fit_camera().
struct CameraFit {
  Vec3 direction = view_direction(StandardView::Iso);  ///< Viewing direction; any length but 0.
  Projection projection = Projection::Orthographic;    ///< Projection of the camera.
  double aspect = 4.0 / 3.0;                           ///< Width of the picture divided by its height.
  double margin = 0.05;                                ///< Empty border on each side, as a fraction of the picture.
};

/// The closest camera that shows all points within the margin. Up is +z, or +y (-y) if it looks straight down (up).
/// Without points it looks at the origin. @pre aspect > 0, 0 <= margin < 0.5
Camera fit_camera(Span<const Vec3> points, const CameraFit& fit = {});

/// The camera's axes as rows: right, up, forward. World frame, orthonormal.
Mat3 camera_axes(const Camera& camera);

}  // namespace dismantle
