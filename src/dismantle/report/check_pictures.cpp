// SPDX-License-Identifier: Apache-2.0
#include "dismantle/report/check_pictures.h"

#include "dismantle/geometry/aabb_corners.h"
#include "dismantle/render/assembly_scene.h"
#include "dismantle/render/render.h"

#include <algorithm>

namespace dismantle {

namespace {

constexpr int kSamples = 2;          // along each side of a pixel
constexpr float kCurveWidth = 2.0f;  // [pixels]
// Margin of a close-up around the overlap, as fractions of the overlap and of the smaller component.
constexpr double kOverlapMargin = 0.3;
constexpr double kComponentMargin = 0.2;

void add_curve(const std::vector<CurveSegment>& curve, RenderScene& scene) {
  Color color = kOverlapColor;
  color.a = 1;
  for (const CurveSegment& s : curve) scene.lines.push_back({{s.ends[0], s.ends[1]}, color, kCurveWidth, true});
}

}  // namespace

CheckPictures::CheckPictures(const Assembly& assembly, int width, int height, const Executor& executor)
    : assembly_(assembly), scene_(make_scene(assembly)) {
  options_.width = width;
  options_.height = height;
  options_.samples = kSamples;
  options_.executor = executor;
}

Image CheckPictures::picture(const RenderScene& scene, const std::vector<Vec3>& points) const {
  CameraFit fit;
  fit.aspect = static_cast<double>(options_.width) / options_.height;
  return render(scene, fit_camera(points, fit), options_);
}

std::vector<CurveSegment> CheckPictures::curve(const ComponentPair& pair) const {
  return intersection_curve(assembled_mesh(assembly_[pair.a]), assembled_mesh(assembly_[pair.b]));
}

Image CheckPictures::overview() const {
  return picture(scene_, item_points(scene_.items));
}

Image CheckPictures::overlaps(const std::vector<ComponentPair>& pairs) const {
  RenderScene scene = scene_;
  for (RenderItem& item : scene.items) make_ghost(item);
  for (const ComponentPair& pair : pairs) add_curve(curve(pair), scene);
  return picture(scene, item_points(scene.items));
}

Image CheckPictures::closeup(const ComponentPair& pair) const {
  RenderScene scene = scene_;
  for (RenderItem& item : scene.items) make_ghost(item);
  RenderItem& first = scene.items[pair.a.value];
  RenderItem& second = scene.items[pair.b.value];
  make_highlighted(first, kFirstColor);
  make_highlighted(second, kSecondColor);
  first.edge_opacity = second.edge_opacity = RenderItem{}.edge_opacity;
  if (first.closed && second.closed) scene.overlap = OverlapMark{{pair.a.value, pair.b.value}, kOverlapColor};

  const std::vector<CurveSegment> cut = curve(pair);
  add_curve(cut, scene);
  Aabb region;
  for (const CurveSegment& s : cut)
    for (const Vec3& end : s.ends) region.extend(end);
  const Aabb box_a = assembled_bounds(assembly_[pair.a]), box_b = assembled_bounds(assembly_[pair.b]);
  if (region.empty()) region = diagonal(box_a) < diagonal(box_b) ? box_a : box_b;
  const double smaller = std::min(diagonal(box_a), diagonal(box_b));
  const double around = std::max(kOverlapMargin * diagonal(region), kComponentMargin * smaller);
  return picture(scene, corners_of(inflated(region, around / 2)));
}

}  // namespace dismantle
