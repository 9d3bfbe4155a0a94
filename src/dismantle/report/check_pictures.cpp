// SPDX-License-Identifier: Apache-2.0
#include "dismantle/report/check_pictures.h"

#include "dismantle/geometry/aabb_corners.h"
#include "dismantle/render/assembly_scene.h"
#include "dismantle/render/render.h"

#include <algorithm>
#include <cmath>

namespace dismantle {

namespace {

constexpr int kSamples = 2;          // along each side of a pixel
constexpr float kCurveWidth = 2.0f;  // [pixels]
// Margin of a close-up around the overlap, as fractions of the overlap and of the smaller component.
constexpr double kOverlapMargin = 0.3;
constexpr double kComponentMargin = 0.2;
constexpr double kStarSize = 0.012;  // of its arms, as a fraction of what a close-up shows
constexpr Color kDeepestColor{0.05f, 0.05f, 0.05f, 1};

void add_curve(const std::vector<CurveSegment>& curve, RenderScene& scene) {
  Color color = kOverlapColor;
  color.a = 1;
  for (const CurveSegment& s : curve) scene.lines.push_back({{s.ends[0], s.ends[1]}, color, kCurveWidth, true});
}

/// A black star at the deepest point.
void add_star(Vec3 at, double size, RenderScene& scene) {
  const double d = size / std::sqrt(3.0);
  for (const Vec3 arm : {Vec3{size, 0, 0}, {0, size, 0}, {0, 0, size}, {d, d, d}, {d, d, -d}, {d, -d, d}, {-d, d, d}})
    scene.lines.push_back({{at - arm, at + arm}, kDeepestColor, kCurveWidth, true});
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

std::vector<CurveSegment> CheckPictures::curve(const Clash& pair) const {
  return intersection_curve(assembled_mesh(assembly_[pair.a]), assembled_mesh(assembly_[pair.b]));
}

Image CheckPictures::overview() const {
  return picture(scene_, item_points(scene_.items));
}

Image CheckPictures::overlaps(const std::vector<Clash>& pairs) const {
  RenderScene scene = scene_;
  for (RenderItem& item : scene.items) make_ghost(item);
  for (const Clash& pair : pairs) add_curve(curve(pair), scene);
  return picture(scene, item_points(scene.items));
}

Image CheckPictures::closeup(const Clash& pair) const {
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
  if (pair.depth_attained > 0) region.extend(pair.deepest_at);
  if (region.empty()) region = diagonal(box_a) < diagonal(box_b) ? box_a : box_b;
  const double smaller = std::min(diagonal(box_a), diagonal(box_b));
  const double around = std::max(kOverlapMargin * diagonal(region), kComponentMargin * smaller);
  const Aabb shown = inflated(region, around / 2);
  if (pair.depth_attained > 0) add_star(pair.deepest_at, kStarSize * diagonal(shown), scene);
  return picture(scene, corners_of(shown));
}

}  // namespace dismantle
