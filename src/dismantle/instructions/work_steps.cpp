// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/work_steps.h"

#include "dismantle/documents/bill_of_materials.h"
#include "dismantle/math/screw.h"
#include "dismantle/session/session_path.h"

#include <algorithm>
#include <cmath>

namespace dismantle {

namespace {

/// Removals are parallel if their directions [sine] and their total rotations [rad] differ by less.
constexpr double kParallel = 0.02;
/// Tolerance of equal poses [mm, quaternion component].
constexpr double kSamePose = 1e-5;

bool same_pose(const Pose& a, const Pose& b) {
  return max_abs(a.position - b.position) <= kSamePose && 1 - std::abs(dot(a.rotation, b.rotation)) <= kSamePose;
}

/// Overall direction and rotation of a removal.
struct Course {
  Vec3 direction;    ///< Of the displacement of the centre; unit vector, or zero.
  double angle = 0;  ///< Total rotation [rad].
};

Course course_of(const Assembly& assembly, const RemovalMove& removal) {
  const Vec3 center = bounds_of(assembly, removal.components).center();
  const Vec3 from = transform_from_pose(removal.poses.front()) * center;
  Course course{normalized(transform_from_pose(removal.poses.back()) * center - from)};
  for (std::size_t i = 1; i < removal.poses.size(); ++i)
    course.angle += screw_between(removal.poses[i - 1], removal.poses[i]).angle;
  return course;
}

bool are_parallel(const Course& a, const Course& b) {
  return length(a.direction - b.direction) < kParallel && std::abs(a.angle - b.angle) < kParallel;
}

/// The lines of the bill of materials of the components of a removal, ascending.
std::vector<std::size_t> kinds_of(const RemovalMove& removal, const std::vector<std::size_t>& lines) {
  std::vector<std::size_t> kinds;
  kinds.reserve(removal.components.size());
  for (const ComponentId c : removal.components) kinds.push_back(lines[c.value]);
  std::sort(kinds.begin(), kinds.end());
  return kinds;
}

std::vector<RemovalMove> removals_of(const Timeline& timeline) {
  std::vector<RemovalMove> removals;
  for (const TimelineMove& move : timeline.moves()) {
    if (removals.empty() || removals.back().components != move.components)
      removals.push_back({move.components, {move.frames.front().pose}});
    for (std::size_t i = 1; i < move.frames.size(); ++i) removals.back().poses.push_back(move.frames[i].pose);
  }
  return removals;
}

}  // namespace

std::vector<WorkStep> work_steps(const Assembly& assembly, const Timeline& timeline, PathDirection direction) {
  const std::vector<std::size_t> kinds = bill_lines(assembly);
  const auto are_equal = [&](const RemovalMove& a, const RemovalMove& b) {
    return kinds_of(a, kinds) == kinds_of(b, kinds) && are_parallel(course_of(assembly, a), course_of(assembly, b));
  };
  std::vector<WorkStep> steps;
  std::vector<Pose> poses(assembly.components.size());
  for (RemovalMove& removal : removals_of(timeline)) {
    if (steps.empty() || !are_equal(steps.back().removals.back(), removal)) steps.push_back({{}, poses});
    for (const ComponentId c : removal.components) poses[c.value] = removal.poses.back();
    steps.back().removals.push_back(std::move(removal));
  }
  if (direction == PathDirection::Reversed) std::reverse(steps.begin(), steps.end());
  return steps;
}

std::vector<ComponentId> surroundings(const WorkStep& step, const RemovalMove& removal) {
  std::vector<ComponentId> others, together;
  for (std::uint32_t c = 0; c < step.before.size(); ++c) {
    const auto& set = removal.components;
    if (std::find(set.begin(), set.end(), ComponentId(c)) != set.end()) continue;
    others.emplace_back(c);
    if (same_pose(step.before[c], removal.poses.front())) together.emplace_back(c);
  }
  return together.empty() ? others : together;
}

std::vector<PathPose> poses_along(const RemovalMove& removal, const Vec3& center, int samples) {
  DISMANTLE_EXPECT(samples >= 1);
  std::vector<PathPose> path{{removal.poses.front(), 0}};
  for (std::size_t i = 1; i < removal.poses.size(); ++i) {
    for (int k = 1; k <= samples; ++k) {
      // Contacts end near the initial pose: the samples are dense there.
      const double share = i == 1 ? std::pow(static_cast<double>(k) / samples, 2) : static_cast<double>(k) / samples;
      const Pose pose = k == samples ? removal.poses[i] : pose_between(removal.poses[i - 1], removal.poses[i], share);
      const Vec3 from = transform_from_pose(path.back().pose) * center;
      path.push_back({pose, path.back().distance + length(transform_from_pose(pose) * center - from)});
    }
  }
  return path;
}

Aabb bounds_of(const Assembly& assembly, Span<const ComponentId> components, const Pose& pose) {
  Aabb box;
  for (const ComponentId c : components) box.extend(bounds_at(assembly[c], pose));
  return box;
}

}  // namespace dismantle
