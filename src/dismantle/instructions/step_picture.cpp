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
constexpr int kWayPieces = 24;
/// A set is shown where it is past the boxes of all components around it by this share of its own size, but no further
/// than so many of its sizes from home, unless that is less than the share of the surroundings; and no nearer than the
/// share of its size, or its arrow would not be seen.
constexpr double kPast = 0.35, kMaxSizes = 3, kMinReach = 0.25, kMinSizes = 0.8;
/// The place where it is past them is found by so many halvings of a screw.
constexpr int kHalvings = 24;
/// A close picture shows this share more around what moves, and at least this share of the surroundings.
constexpr double kAround = 0.35, kMinRegion = 0.15;
/// One that would show more than this share of the surroundings shows all of them.
constexpr double kAlmostAll = 0.6;
/// Arrows have this share of the picture's diagonal as radius, but are so many radii long; ways shorter than so many of
/// the share have none.
constexpr double kArrowRadius = 0.006, kSlimmest = 7, kShortestWay = 1;
/// Samples along a pixel's side: on paper pixels are small.
constexpr int kSamples = 2;
/// Views are judged in pictures of so many pixels.
constexpr int kJudgedWidth = 120, kJudgedHeight = 90;
/// What counts for a view: how much of the set is seen, of its other end, how long its way looks; views from below, and
/// others than the last, count less.
constexpr double kSeenWorth = 1, kEndWorth = 0.4, kWayWorth = 0.6, kBelowCost = 0.3, kChangeCost = 0.15;
/// A set of which less is seen, of what could be, is shown through what hides it.
constexpr double kMinSeen = 0.12;
constexpr float kSeeThrough = 0.25f;
/// An arrow around an axis turns by no more [rad].
constexpr double kMaxTurn = 4.7;

/// Views from around, 30 degrees from above and 25 from below, and from the top.
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

/// What of a removal's way a picture shows: from home to the first place where it is seen to be out.
/// @param around boxes of the components around it
std::vector<PathPose> shown_way(const Assembly& assembly, const RemovalMove& removal, const std::vector<Aabb>& around) {
  const Vec3 middle = bounds_of(assembly, removal.components).center();
  std::vector<PathPose> places = poses_along(removal, middle, removal.poses.size() > kWayPieces ? 1 : kWayPieces);
  Aabb all;
  for (const Aabb& box : around) all.extend(box);
  const double size = diagonal(bounds_of(assembly, removal.components));
  const double most = std::max(kMaxSizes * size, kMinReach * diagonal(all));
  const auto is_out = [&](const PathPose& place) {
    if (place.distance >= most) return true;
    const Aabb own = inflated(bounds_of(assembly, removal.components, place.pose), kPast * size / 2);
    return place.distance >= kMinSizes * size &&
           std::none_of(around.begin(), around.end(), [&](const Aabb& box) { return overlaps(own, box); });
  };
  const auto out = std::find_if(places.begin(), places.end(), is_out);
  if (out == places.end() || out == places.begin()) return places;

  PathPose before = out[-1];
  for (int i = 0; i < kHalvings; ++i) {
    const Pose pose = pose_between(before.pose, out->pose, 0.5);
    const PathPose half{pose, (before.distance + out->distance) / 2};
    (is_out(half) ? *out : before) = half;
  }
  places.erase(out + 1, places.end());
  return places;
}

/// The way of the set's middle.
std::vector<Vec3> line_of(const std::vector<PathPose>& places, const Vec3& middle) {
  std::vector<Vec3> line;
  for (const PathPose& place : places) {
    const Vec3 point = transform_from_pose(place.pose) * middle;
    if (line.empty() || length(point - line.back()) > 0) line.push_back(point);
  }
  return line;
}

/// An arc around the axis of a leg that turns, at the set's outer end, in the sense in which it is gone.
std::vector<Vec3> arc_of(const Leg& leg, const Aabb& box, PathDirection direction) {
  const Vec3 axis = leg.direction;
  const double turn = std::min(leg.angle, kMaxTurn);
  const Vec3 middle = leg.axis_point + dot(box.center() - leg.axis_point, axis) * axis;
  const Vec3 across = normalized(cross(axis, std::abs(axis.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
  double radius = 0;
  for (const Vec3& corner : corners_of(box)) radius = std::max(radius, length(cross(axis, corner - middle)));
  std::vector<Vec3> arc;
  arc.reserve(kWayPieces + 1);
  for (int i = 0; i <= kWayPieces; ++i) {
    const double angle = turn * i / kWayPieces;
    arc.push_back(middle + 0.9 * radius * (std::cos(angle) * across + std::sin(angle) * cross(axis, across)));
  }
  if (direction == PathDirection::Reversed) std::reverse(arc.begin(), arc.end());
  return arc;
}

}  // namespace

/// What a step's pictures show.
struct StepPictureTaker::Subject {
  RenderScene scene;                     ///< The surroundings, what moves, and ghosts.
  std::vector<std::size_t> moving;       ///< Items.
  std::vector<std::size_t> ghosts;       ///< Items.
  std::vector<std::vector<Vec3>> lines;  ///< Of the arrows.
  Aabb region, surroundings;
};

StepPictureTaker::StepPictureTaker(const Assembly& assembly, int width, int height, const Executor& executor)
    : assembly_(assembly), scene_(make_scene(assembly)) {
  options_.width = width;
  options_.height = height;
  options_.samples = kSamples;
  options_.executor = executor;
}

Image StepPictureTaker::cover() const {
  CameraFit fit;
  fit.aspect = static_cast<double>(options_.width) / options_.height;
  return render(scene_, fit_camera(item_points(scene_.items), fit), options_);
}

StepPictureTaker::Subject StepPictureTaker::subject_of(const WorkStep& step, PathDirection direction) const {
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
    const Vec3 middle = bounds_of(assembly_, removal.components).center();
    const std::vector<PathPose> way = shown_way(assembly_, removal, around);
    const Pose from = is_forward ? way.front().pose : way.back().pose,
               to = is_forward ? way.back().pose : way.front().pose;
    for (const ComponentId c : removal.components) {
      subject.moving.push_back(subject.scene.items.size());
      make_highlighted(add(c, from), kMovingColor);
      subject.ghosts.push_back(subject.scene.items.size());
      add(c, to).color = kGhostColor;
    }
    subject.region.extend(home);
    subject.region.extend(bounds_of(assembly_, removal.components, way.back().pose));
    subject.lines.push_back(line_of(way, middle));
    if (!is_forward) std::reverse(subject.lines.back().begin(), subject.lines.back().end());
    for (const Leg& leg : legs_of(removal, middle))
      if (is_screwing(leg))
        subject.lines.push_back(arc_of(leg, bounds_of(assembly_, removal.components, way.back().pose), direction));
  }
  subject.surroundings.extend(subject.region);
  const double least = kMinRegion * diagonal(subject.surroundings);
  subject.region =
      inflated(subject.region, std::max(kAround * diagonal(subject.region), least - diagonal(subject.region)) / 2);
  if (diagonal(subject.region) > kAlmostAll * diagonal(subject.surroundings)) subject.region = subject.surroundings;
  return subject;
}

Vec3 StepPictureTaker::best_view(const Subject& subject) const {
  const std::vector<Vec3> views = candidate_views();
  std::vector<std::array<double, 3>> seen(views.size());  // pixels of what moves, of its ghosts, and the way's length
  RenderScene scene = subject.scene;
  for (const std::size_t i : subject.ghosts) scene.items[i].color.a = 1;
  options_.executor.for_each_heavy(views.size(), [&](std::size_t v) {
    CameraFit fit;
    fit.direction = views[v];
    fit.aspect = static_cast<double>(kJudgedWidth) / kJudgedHeight;
    const Camera camera = fit_camera(corners_of(subject.region), fit);
    const std::vector<std::size_t> pixels = visible_pixels(scene, camera, kJudgedWidth, kJudgedHeight);
    const double scale = camera.height * camera.height;  // pixels show more of the world in a larger picture
    for (const std::size_t i : subject.moving) seen[v][0] += static_cast<double>(pixels[i]) * scale;
    for (const std::size_t i : subject.ghosts) seen[v][1] += static_cast<double>(pixels[i]) * scale;
    const std::vector<Vec3>& line = subject.lines.front();
    const Vec3 way = line.back() - line.front();
    seen[v][2] = length(way) > 0 ? length(cross(views[v], normalized(way))) : 0;
  });
  double most[2] = {1e-300, 1e-300};
  for (const auto& s : seen)
    for (const int k : {0, 1}) most[k] = std::max(most[k], s[k]);
  std::size_t best = 0;
  double best_worth = -1;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const double worth = kSeenWorth * std::sqrt(seen[v][0] / most[0]) + kEndWorth * std::sqrt(seen[v][1] / most[1]) +
                         kWayWorth * seen[v][2] - (views[v].z > 0 ? kBelowCost : 0) -
                         (views[v] == last_view_ ? 0 : kChangeCost);
    if (worth > best_worth) {
      best = v;
      best_worth = worth;
    }
  }
  return views[best];
}

double StepPictureTaker::seen_share(const Subject& subject, const Vec3& view) const {
  CameraFit fit;
  fit.direction = view;
  fit.aspect = static_cast<double>(kJudgedWidth) / kJudgedHeight;
  const Camera camera = fit_camera(corners_of(subject.region), fit);
  RenderScene alone;
  for (const std::size_t i : subject.moving) alone.items.push_back(subject.scene.items[i]);
  const std::vector<std::size_t> all = visible_pixels(subject.scene, camera, kJudgedWidth, kJudgedHeight);
  const std::vector<std::size_t> most = visible_pixels(alone, camera, kJudgedWidth, kJudgedHeight);
  std::size_t seen = 0;
  for (const std::size_t i : subject.moving) seen += all[i];
  const std::size_t could = std::accumulate(most.begin(), most.end(), std::size_t{0});
  return could == 0 ? 0 : static_cast<double>(seen) / static_cast<double>(could);
}

Image StepPictureTaker::take(const Subject& subject, const Vec3& view, const std::vector<Vec3>& points,
                             int divisor) const {
  CameraFit fit;
  fit.direction = view;
  fit.aspect = static_cast<double>(options_.width) / options_.height;
  const Camera camera = fit_camera(points, fit);
  RenderScene scene = subject.scene;
  const double radius = kArrowRadius * std::hypot(1, fit.aspect) * camera.height;
  for (const std::vector<Vec3>& line : subject.lines) {
    double way = 0;
    for (std::size_t i = 1; i < line.size(); ++i) way += length(line[i] - line[i - 1]);
    if (way > kShortestWay * radius)
      scene.items.push_back(make_curved_arrow(line, std::min(radius, way / kSlimmest), kArrowColor));
  }
  RenderOptions options = options_;
  options.width /= divisor;
  options.height /= divisor;
  return render(scene, camera, options);
}

StepPictures StepPictureTaker::take(const WorkStep& step, PathDirection direction) {
  Subject subject = subject_of(step, direction);
  StepPictures pictures;
  pictures.view = last_view_ = best_view(subject);
  if (seen_share(subject, pictures.view) < kMinSeen)
    for (std::size_t i = 0; i < subject.moving.front(); ++i) subject.scene.items[i].color.a = kSeeThrough;
  const bool is_part = !(subject.region == subject.surroundings);
  pictures.close = take(subject, pictures.view, corners_of(subject.region), 1);
  if (is_part) pictures.overview = take(subject, pictures.view, corners_of(subject.surroundings), 3);
  return pictures;
}

}  // namespace dismantle
