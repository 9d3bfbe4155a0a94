// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/step_picture.h"

#include "dismantle/geometry/aabb_corners.h"
#include "dismantle/instructions/motion_text.h"
#include "dismantle/math/screw.h"
#include "dismantle/render/assembly_scene.h"
#include "dismantle/render/render.h"
#include "dismantle/render/visible_pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace dismantle {

namespace {

constexpr Color kMovingColor{0.95f, 0.55f, 0.10f};
constexpr Color kGhostColor{0.95f, 0.55f, 0.10f, 0.30f};
constexpr Color kArrowColor{0.05f, 0.35f, 0.65f};
constexpr int kPathSamples = 24;
/// The path is shown up to where the set has cleared the boxes of all surrounding components by kMargin of its size,
/// but no further than the larger of kMaxSizes of its size and kMinReach of the size of the surroundings, and no less
/// than kMinSizes of its size, so that the arrow is visible.
constexpr double kMargin = 0.35, kMaxSizes = 3, kMinReach = 0.25, kMinSizes = 0.8;
/// Number of bisections of a screw motion that locate the end of the section shown.
constexpr int kHalvings = 24;
/// Margin of a close picture around the moving set, and its minimum size as a fraction of the surroundings.
constexpr double kRegionMargin = 0.35, kMinRegion = 0.15;
/// A region larger than this fraction of the surroundings is extended to all of them.
constexpr double kMaxRegion = 0.6;
/// Radius of arrows as a fraction of the picture's diagonal; the minimum ratio of length to radius of an arrow; and the
/// minimum path length, in radii, that gets an arrow.
constexpr double kArrowRadius = 0.006, kMinArrowLength = 7, kMinPathLength = 1;
/// Samples along each side of a pixel; printed pixels are small.
constexpr int kSamples = 2;
/// Size of the images in which views are compared [pixels].
constexpr int kViewWidth = 120, kViewHeight = 90;
/// Score of a view: visibility of the set, of its ghost, and apparent length of the path; views from below and views
/// other than the last one are penalised.
constexpr double kSetWeight = 1, kGhostWeight = 0.4, kPathWeight = 0.6, kBelowPenalty = 0.3, kChangePenalty = 0.15;
/// Below this visible fraction of the set, the surroundings become transparent.
constexpr double kMinVisible = 0.12;
constexpr float kTransparentOpacity = 0.25f;
/// Maximum angle of an arrow around an axis [rad].
constexpr double kMaxTurn = 4.7;

/// Eight views around z from 30 degrees above, eight from 25 degrees below, and one from the top.
std::vector<Vec3> candidate_views() {
  std::vector<Vec3> views;
  views.reserve(17);
  const double eighth = std::acos(-1.0) / 4;
  for (const double height : {std::tan(eighth * 2 / 3), -std::tan(eighth * 5 / 9)})
    for (int i = 0; i < 8; ++i)
      views.push_back(normalized(Vec3{std::cos(eighth * (i + 0.5)), std::sin(eighth * (i + 0.5)), -height}));
  views.push_back(view_direction(StandardView::Top));
  return views;
}

/// The section of a removal path that a picture shows: from the start to where the set has cleared its surroundings.
/// @param around boxes of the surrounding components
std::vector<PathPose> shown_path(const Assembly& assembly, const RemovalMove& removal,
                                 const std::vector<Aabb>& around) {
  const Vec3 center = bounds_of(assembly, removal.components).center();
  std::vector<PathPose> path = poses_along(removal, center, removal.poses.size() > kPathSamples ? 1 : kPathSamples);
  Aabb all;
  for (const Aabb& box : around) all.extend(box);
  const double size = diagonal(bounds_of(assembly, removal.components));
  const double max_distance = std::max(kMaxSizes * size, kMinReach * diagonal(all));
  const auto is_out = [&](const PathPose& sample) {
    if (sample.distance >= max_distance) return true;
    const Aabb own = inflated(bounds_of(assembly, removal.components, sample.pose), kMargin * size / 2);
    return sample.distance >= kMinSizes * size &&
           std::none_of(around.begin(), around.end(), [&](const Aabb& box) { return overlaps(own, box); });
  };
  const auto out = std::find_if(path.begin(), path.end(), is_out);
  if (out == path.end() || out == path.begin()) return path;

  PathPose before = out[-1];
  for (int i = 0; i < kHalvings; ++i) {
    const Pose pose = pose_between(before.pose, out->pose, 0.5);
    const PathPose half{pose, (before.distance + out->distance) / 2};
    (is_out(half) ? *out : before) = half;
  }
  path.erase(out + 1, path.end());
  return path;
}

/// The path of the centre of the set, without repeated points.
std::vector<Vec3> line_of(const std::vector<PathPose>& path, const Vec3& center) {
  std::vector<Vec3> line;
  for (const PathPose& sample : path) {
    const Vec3 point = transform_from_pose(sample.pose) * center;
    if (line.empty() || length(point - line.back()) > 0) line.push_back(point);
  }
  return line;
}

/// An arc around the axis of a screw motion, around the set's box, in the sense of the rotation.
std::vector<Vec3> arc_of(const Leg& leg, const Aabb& box, PathDirection direction) {
  const Vec3 axis = leg.direction;
  const double turn = std::min(leg.angle, kMaxTurn);
  const Vec3 center = leg.axis_point + dot(box.center() - leg.axis_point, axis) * axis;
  const Vec3 across = normalized(cross(axis, std::abs(axis.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
  double radius = 0;
  for (const Vec3& corner : corners_of(box)) radius = std::max(radius, length(cross(axis, corner - center)));
  std::vector<Vec3> arc;
  arc.reserve(kPathSamples + 1);
  for (int i = 0; i <= kPathSamples; ++i) {
    const double angle = turn * i / kPathSamples;
    arc.push_back(center + 0.9 * radius * (std::cos(angle) * across + std::sin(angle) * cross(axis, across)));
  }
  if (direction == PathDirection::Reversed) std::reverse(arc.begin(), arc.end());
  return arc;
}

}  // namespace

/// The contents of a step's pictures.
struct StepPictureRenderer::Subject {
  RenderScene scene;                     ///< Surroundings, moving set and ghosts.
  std::vector<std::size_t> moving;       ///< Items of the moving set.
  std::vector<std::size_t> ghosts;       ///< Items of its ghosts.
  std::vector<std::vector<Vec3>> lines;  ///< Polylines of the arrows.
  Aabb region, surroundings;             ///< What the close picture and the overview show.
};

StepPictureRenderer::StepPictureRenderer(const Assembly& assembly, int width, int height, const Executor& executor)
    : assembly_(assembly), scene_(make_scene(assembly)) {
  options_.width = width;
  options_.height = height;
  options_.samples = kSamples;
  options_.executor = executor;
}

Image StepPictureRenderer::cover() const {
  CameraFit fit;
  fit.aspect = static_cast<double>(options_.width) / options_.height;
  return render(scene_, fit_camera(item_points(scene_.items), fit), options_);
}

StepPictureRenderer::Subject StepPictureRenderer::subject_of(const WorkStep& step, PathDirection direction) const {
  const bool is_forward = direction == PathDirection::Forward;
  Subject subject;
  std::vector<bool> moves(assembly_.components.size());
  for (const RemovalMove& removal : step.removals)
    for (const ComponentId c : removal.components) moves[c.value] = true;
  const auto add = [&](ComponentId c, const Pose& pose) -> RenderItem& {
    RenderItem item = scene_.items[c.value];
    item.world_from_mesh = transform_from_pose(pose) * assembly_[c].assembly_from_mesh;
    subject.scene.items.push_back(std::move(item));
    return subject.scene.items.back();
  };
  std::vector<Aabb> around;
  for (const ComponentId c : surroundings(step, step.removals.front())) {
    if (moves[c.value]) continue;
    add(c, step.before[c.value]);
    around.push_back(bounds_of(assembly_, {&c, 1}, step.before[c.value]));
    subject.surroundings.extend(around.back());
  }
  for (const RemovalMove& removal : step.removals) {
    const Aabb home = bounds_of(assembly_, removal.components, removal.poses.front());
    const Vec3 center = bounds_of(assembly_, removal.components).center();
    const std::vector<PathPose> path = shown_path(assembly_, removal, around);
    const Pose from = is_forward ? path.front().pose : path.back().pose,
               to = is_forward ? path.back().pose : path.front().pose;
    for (const ComponentId c : removal.components) {
      subject.moving.push_back(subject.scene.items.size());
      make_highlighted(add(c, from), kMovingColor);
      subject.ghosts.push_back(subject.scene.items.size());
      add(c, to).color = kGhostColor;
    }
    subject.region.extend(home);
    subject.region.extend(bounds_of(assembly_, removal.components, path.back().pose));
    subject.lines.push_back(line_of(path, center));
    if (!is_forward) std::reverse(subject.lines.back().begin(), subject.lines.back().end());
    for (const Leg& leg : legs_of(removal, center))
      if (is_screwing(leg))
        subject.lines.push_back(arc_of(leg, bounds_of(assembly_, removal.components, path.back().pose), direction));
  }
  subject.surroundings.extend(subject.region);
  const double min_size = kMinRegion * diagonal(subject.surroundings);
  subject.region = inflated(
      subject.region, std::max(kRegionMargin * diagonal(subject.region), min_size - diagonal(subject.region)) / 2);
  if (diagonal(subject.region) > kMaxRegion * diagonal(subject.surroundings)) subject.region = subject.surroundings;
  return subject;
}

Vec3 StepPictureRenderer::best_view(const Subject& subject) const {
  const std::vector<Vec3> views = candidate_views();
  std::vector<std::array<double, 3>> visible(
      views.size());  // area of the set, area of its ghosts, apparent path length
  RenderScene scene = subject.scene;
  for (const std::size_t i : subject.ghosts) scene.items[i].color.a = 1;
  options_.executor.for_each_heavy(views.size(), [&](std::size_t v) {
    CameraFit fit;
    fit.direction = views[v];
    fit.aspect = static_cast<double>(kViewWidth) / kViewHeight;
    const Camera camera = fit_camera(corners_of(subject.region), fit);
    const std::vector<std::size_t> pixels = visible_pixels(scene, camera, kViewWidth, kViewHeight);
    const double scale = camera.height * camera.height;  // proportional to the area of a pixel
    for (const std::size_t i : subject.moving) visible[v][0] += static_cast<double>(pixels[i]) * scale;
    for (const std::size_t i : subject.ghosts) visible[v][1] += static_cast<double>(pixels[i]) * scale;
    const std::vector<Vec3>& line = subject.lines.front();
    const Vec3 displacement = line.back() - line.front();
    visible[v][2] = length(displacement) > 0 ? length(cross(views[v], normalized(displacement))) : 0;
  });
  double max_area[2] = {1e-300, 1e-300};
  for (const auto& s : visible)
    for (const int k : {0, 1}) max_area[k] = std::max(max_area[k], s[k]);
  std::size_t best = 0;
  double best_score = -1;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const double score = kSetWeight * std::sqrt(visible[v][0] / max_area[0]) +
                         kGhostWeight * std::sqrt(visible[v][1] / max_area[1]) + kPathWeight * visible[v][2] -
                         (views[v].z > 0 ? kBelowPenalty : 0) - (views[v] == last_view_ ? 0 : kChangePenalty);
    if (score > best_score) {
      best = v;
      best_score = score;
    }
  }
  return views[best];
}

double StepPictureRenderer::visible_share(const Subject& subject, const Vec3& view) const {
  CameraFit fit;
  fit.direction = view;
  fit.aspect = static_cast<double>(kViewWidth) / kViewHeight;
  const Camera camera = fit_camera(corners_of(subject.region), fit);
  RenderScene alone;
  for (const std::size_t i : subject.moving) alone.items.push_back(subject.scene.items[i]);
  const std::vector<std::size_t> in_scene = visible_pixels(subject.scene, camera, kViewWidth, kViewHeight);
  const std::vector<std::size_t> unoccluded = visible_pixels(alone, camera, kViewWidth, kViewHeight);
  std::size_t visible = 0;
  for (const std::size_t i : subject.moving) visible += in_scene[i];
  const std::size_t total = std::accumulate(unoccluded.begin(), unoccluded.end(), std::size_t{0});
  return total == 0 ? 0 : static_cast<double>(visible) / static_cast<double>(total);
}

Image StepPictureRenderer::render_view(const Subject& subject, const Vec3& view, const std::vector<Vec3>& points,
                                       int divisor) const {
  CameraFit fit;
  fit.direction = view;
  fit.aspect = static_cast<double>(options_.width) / options_.height;
  const Camera camera = fit_camera(points, fit);
  RenderScene scene = subject.scene;
  const double radius = kArrowRadius * std::hypot(1, fit.aspect) * camera.height;
  for (const std::vector<Vec3>& line : subject.lines) {
    double path_length = 0;
    for (std::size_t i = 1; i < line.size(); ++i) path_length += length(line[i] - line[i - 1]);
    if (path_length > kMinPathLength * radius)
      scene.items.push_back(make_curved_arrow(line, std::min(radius, path_length / kMinArrowLength), kArrowColor));
  }
  RenderOptions options = options_;
  options.width /= divisor;
  options.height /= divisor;
  return render(scene, camera, options);
}

StepPictures StepPictureRenderer::render_step(const WorkStep& step, PathDirection direction) {
  Subject subject = subject_of(step, direction);
  StepPictures pictures;
  pictures.view = last_view_ = best_view(subject);
  if (visible_share(subject, pictures.view) < kMinVisible)
    for (std::size_t i = 0; i < subject.moving.front(); ++i) subject.scene.items[i].color.a = kTransparentOpacity;
  const bool is_close_up = !(subject.region == subject.surroundings);
  pictures.close = render_view(subject, pictures.view, corners_of(subject.region), 1);
  if (is_close_up) pictures.overview = render_view(subject, pictures.view, corners_of(subject.surroundings), 3);
  return pictures;
}

}  // namespace dismantle
