// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/exploded_overview.h"

#include "dismantle/render/assembly_scene.h"
#include "dismantle/render/render.h"
#include "dismantle/render/visible_pixels.h"

#include <algorithm>

namespace dismantle {

namespace {

/// Displacement of a component, as a multiple of its distance from the centre.
constexpr double kExplode = 1;
/// Border for the balloons, and the places of their columns, as fractions of the picture.
constexpr double kBorder = 0.1, kLeftColumn = 0.035, kRightColumn = 1 - kLeftColumn;
/// Samples along each side of a pixel; printed pixels are small.
constexpr int kSamples = 2;
/// Width of the image in which components are looked for [pixels].
constexpr int kSearchWidth = 480;

/// Where a point of the world is in an orthographic picture.
PicturePoint projected(const Vec3& point, const Camera& camera, double aspect) {
  const Mat3 axes = camera_axes(camera);
  const Vec3 in_view = axes * (point - camera.target);
  return {0.5 + in_view.x / (camera.height * aspect), 0.5 - in_view.y / camera.height};
}

Vec3 center_of(const RenderItem& item) {
  Aabb box;
  for (const Vec3& point : item_points({&item, 1})) box.extend(point);
  return box.center();
}

/// Spreads balloons evenly over a column, in the order of their anchors.
void place_column(std::vector<Balloon>& balloons, double column) {
  std::stable_sort(balloons.begin(), balloons.end(),
                   [](const Balloon& a, const Balloon& b) { return a.anchor.y < b.anchor.y; });
  for (std::size_t i = 0; i < balloons.size(); ++i)
    balloons[i].place = {column, (static_cast<double>(i) + 0.5) / static_cast<double>(balloons.size())};
}

}  // namespace

ExplodedOverview exploded_overview(const Assembly& assembly, const std::vector<BillItem>& bill, int width, int height,
                                   const Executor& executor) {
  const RenderScene scene = make_scene(assembly, {kExplode});
  CameraFit fit;
  fit.aspect = static_cast<double>(width) / height;
  fit.margin = kBorder;
  const Camera camera = fit_camera(item_points(scene.items), fit);
  RenderOptions options;
  options.width = width;
  options.height = height;
  options.samples = kSamples;
  options.executor = executor;
  ExplodedOverview overview{render(scene, camera, options), {}};

  const int search_height = std::max(1, static_cast<int>(kSearchWidth / fit.aspect));
  const std::vector<std::size_t> pixels = visible_pixels(scene, camera, kSearchWidth, search_height);
  std::vector<std::size_t> items(bill.size());
  for (std::size_t item = 0; item < items.size(); ++item) items[item] = item;
  std::stable_sort(items.begin(), items.end(),
                   [&](std::size_t a, std::size_t b) { return length(bill[a].size) > length(bill[b].size); });
  items.resize(std::min(items.size(), kMaxBalloons));

  std::vector<Balloon> all;
  for (const std::size_t item : items) {
    const std::vector<ComponentId>& components = bill[item].components;
    const ComponentId best = *std::max_element(components.begin(), components.end(), [&](ComponentId a, ComponentId b) {
      return pixels[a.value] < pixels[b.value];
    });
    const PicturePoint anchor = projected(center_of(scene.items[best.value]), camera, fit.aspect);
    all.push_back({item, anchor, {}});
  }
  std::stable_sort(all.begin(), all.end(), [](const Balloon& a, const Balloon& b) { return a.anchor.x < b.anchor.x; });
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::vector<Balloon> left(all.begin(), middle), right(middle, all.end());
  place_column(left, kLeftColumn);
  place_column(right, kRightColumn);
  overview.balloons = std::move(left);
  overview.balloons.insert(overview.balloons.end(), right.begin(), right.end());
  return overview;
}

}  // namespace dismantle
