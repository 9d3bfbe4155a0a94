// SPDX-License-Identifier: Apache-2.0
#include "dismantle/render/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace dismantle {
namespace {

struct ScreenPoint {
  double x, y;
};

/// A point's position in the picture: 0 to 1 from left to right and from top to bottom.
ScreenPoint seen_at(const Camera& camera, double aspect, Vec3 point) {
  const Vec3 p = camera_axes(camera) * (point - camera.eye);
  const bool perspective = camera.projection == Projection::Perspective;
  const double half = perspective ? p.z * std::tan(camera.field_of_view / 2) : camera.height / 2;
  return {0.5 + p.x / half / aspect / 2, 0.5 - p.y / half / 2};
}

TEST(StandardViews, KnowTheirNames) {
  EXPECT_EQ(standard_view("iso"), StandardView::Iso);
  EXPECT_EQ(standard_view("bottom"), StandardView::Bottom);
  EXPECT_FALSE(standard_view("Front").has_value());
  EXPECT_FALSE(standard_view("").has_value());
}

TEST(StandardViews, ShowTheSidesThatDrawingsShow) {
  const std::vector<Vec3> points{{-1, -1, -1}, {1, 1, 1}};
  const auto at = [&](StandardView view, Vec3 p) {
    CameraFit fit;
    fit.direction = view_direction(view);
    return seen_at(fit_camera(points, fit), fit.aspect, p);
  };
  EXPECT_GT(at(StandardView::Front, {1, 0, 0}).x, 0.5);  // +x to the right
  EXPECT_LT(at(StandardView::Front, {0, 0, 1}).y, 0.5);  // +z up
  EXPECT_LT(at(StandardView::Back, {1, 0, 0}).x, 0.5);
  EXPECT_GT(at(StandardView::Right, {0, 1, 0}).x, 0.5);
  EXPECT_LT(at(StandardView::Left, {0, 1, 0}).x, 0.5);
  EXPECT_GT(at(StandardView::Top, {1, 0, 0}).x, 0.5);
  EXPECT_LT(at(StandardView::Top, {0, 1, 0}).y, 0.5);  // +y up
  EXPECT_GT(at(StandardView::Bottom, {1, 0, 0}).x, 0.5);
  EXPECT_LT(at(StandardView::Iso, {0, 0, 1}).y, 0.5);
}

TEST(FitCamera, SeesAllPointsAndFillsThePicture) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> at(-50, 80);
  for (const Projection projection : {Projection::Orthographic, Projection::Perspective}) {
    for (int i = 0; i < 40; ++i) {
      std::vector<Vec3> points;
      for (int k = 0; k < 20; ++k) points.push_back({at(random), 3 * at(random), 0.1 * at(random)});
      CameraFit fit{{at(random), at(random), at(random)}, projection, 0.5 + i * 0.1, 0.05};
      const Camera camera = fit_camera(points, fit);
      double margin = 1;
      for (const Vec3& p : points) {
        const ScreenPoint s = seen_at(camera, fit.aspect, p);
        margin = std::min({margin, s.x, 1 - s.x, s.y, 1 - s.y});
      }
      EXPECT_NEAR(margin, fit.margin, 1e-9);
    }
  }
}

TEST(FitCamera, FacesTheOriginWithoutPoints) {
  EXPECT_EQ(fit_camera(Span<const Vec3>{}).target, (Vec3{}));
}

TEST(CameraAxes, AreOrthonormalEvenIfUpIsAlongTheLineOfSight) {
  Camera camera;
  camera.eye = {0, 0, 5};
  camera.target = {0, 0, 1};
  camera.up = {0, 0, 1};
  EXPECT_NEAR(determinant(camera_axes(camera)), -1, 1e-12);  // right, up, forward is left-handed
}

}  // namespace
}  // namespace dismantle
