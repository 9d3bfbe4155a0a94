// SPDX-License-Identifier: Apache-2.0
#include "dismantle/export/step_scene.h"

#include "dismantle/render/assembly_scene.h"

#include <utility>

namespace dismantle {

namespace {

constexpr Color kMovingColor{0.95f, 0.55f, 0.10f};
constexpr Color kArrowColor{0.05f, 0.35f, 0.65f};
constexpr double kArrowRadius = 0.006;  // fraction of the assembly's diagonal
constexpr double kMinArrow = 4;         // length in radii: a shorter arrow would be all head

}  // namespace

RenderScene step_scene(const Assembly& assembly, const Timeline& timeline, std::size_t step, PathDirection direction) {
  const std::size_t count = timeline.moves().size();
  DISMANTLE_EXPECT(step < count);
  const bool is_forward = direction == PathDirection::Forward;
  const std::size_t index = is_forward ? step : count - 1 - step;
  const TimelineMove& move = timeline.moves()[index];
  Pose from = move.frames.front().pose, to = move.frames.back().pose;
  if (!is_forward) std::swap(from, to);

  AssemblySceneOptions options;
  options.poses = timeline.poses_at({index, 0, 0}, assembly.components.size());
  for (const ComponentId c : move.components) options.poses[c.value] = from;
  RenderScene scene = make_scene(assembly, options);

  Aabb box;
  for (const ComponentId c : move.components) {
    RenderItem ghost = scene.items[c.value];
    ghost.world_from_mesh = transform_from_pose(to) * assembly[c].assembly_from_mesh;
    make_ghost(ghost);
    scene.items.push_back(std::move(ghost));
    make_highlighted(scene.items[c.value], kMovingColor);
    box.extend(assembled_bounds(assembly[c]));
  }
  const Aabb all = assembled_bounds(assembly);
  if (box.empty() || all.empty()) return scene;
  const double radius = kArrowRadius * length(all.size());
  const Vec3 start = transform_from_pose(from) * box.center(), end = transform_from_pose(to) * box.center();
  if (length(end - start) > kMinArrow * radius) scene.items.push_back(make_arrow(start, end, radius, kArrowColor));
  return scene;
}

}  // namespace dismantle
