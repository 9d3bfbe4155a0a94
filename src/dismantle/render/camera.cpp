// SPDX-License-Identifier: Apache-2.0
#include "dismantle/render/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace dismantle {

namespace {

/// The smallest eye-to-target distance at which a point at (x, y, depth) from the target is inside the viewing frustum.
double fitting_distance(Vec3 point, double tangent_x, double tangent_y) {
  return std::max(std::abs(point.x) / tangent_x, std::abs(point.y) / tangent_y) - point.z;
}

}  // namespace

std::optional<StandardView> standard_view(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, StandardView>, 7> kViews{{{"iso", StandardView::Iso},
                                                                                    {"front", StandardView::Front},
                                                                                    {"back", StandardView::Back},
                                                                                    {"left", StandardView::Left},
                                                                                    {"right", StandardView::Right},
                                                                                    {"top", StandardView::Top},
                                                                                    {"bottom", StandardView::Bottom}}};
  for (const auto& [word, view] : kViews)
    if (word == name) return view;
  return std::nullopt;
}

Vec3 view_direction(StandardView view) {
  switch (view) {
    case StandardView::Iso:
      return normalized(Vec3{-1, 1, -0.8});
    case StandardView::Front:
      return {0, 1, 0};
    case StandardView::Back:
      return {0, -1, 0};
    case StandardView::Left:
      return {1, 0, 0};
    case StandardView::Right:
      return {-1, 0, 0};
    case StandardView::Top:
      return {0, 0, -1};
    case StandardView::Bottom:
      return {0, 0, 1};
  }
  return {0, 1, 0};
}

Mat3 camera_axes(const Camera& camera) {
  const Vec3 forward = normalized(camera.target - camera.eye);
  Vec3 right = normalized(cross(forward, camera.up));
  if (right == Vec3{}) right = normalized(cross(forward, forward.x * forward.x < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
  return {{right, cross(right, forward), forward}};
}

Camera fit_camera(Span<const Vec3> points, const CameraFit& fit) {
  DISMANTLE_EXPECT(fit.aspect > 0 && fit.margin >= 0 && fit.margin < 0.5);
  const Vec3 forward = normalized(fit.direction);
  Camera camera;
  camera.projection = fit.projection;
  if (std::abs(forward.z) > 0.999) camera.up = {0, forward.z < 0 ? 1.0 : -1.0, 0};
  camera.eye = -forward;
  if (points.empty()) return camera;

  const Mat3 axes = camera_axes(camera);
  Aabb extent;  // in the camera's frame
  for (const Vec3& p : points) extent.extend(axes * p);
  const Vec3 center = extent.center(), size = extent.size();
  camera.target = transposed(axes) * center;
  const double radius = std::max(length(size) / 2, 1e-9);
  const double fill = 1 - 2 * fit.margin;
  camera.height = std::max({size.y, size.x / fit.aspect, 1e-9 * radius}) / fill;

  double distance = 2 * radius;
  if (fit.projection == Projection::Perspective) {
    const double tangent_y = std::tan(camera.field_of_view / 2) * fill, tangent_x = tangent_y * fit.aspect;
    distance = 0.1 * radius;
    for (const Vec3& p : points)
      distance = std::max(distance, fitting_distance(axes * p - center, tangent_x, tangent_y));
  }
  camera.eye = camera.target - distance * forward;
  return camera;
}

}  // namespace dismantle
