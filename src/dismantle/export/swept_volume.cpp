// SPDX-License-Identifier: Apache-2.0
#include "dismantle/export/swept_volume.h"

#include "dismantle/export/cell_grid.h"
#include "dismantle/math/screw.h"
#include "dismantle/surface/solid_tree_query.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dismantle {

namespace {

/// Between two sampled poses no point travels further than this fraction of a cell's side.
constexpr double kStepShare = 0.5;
/// Tolerance in sides of a cell: the diagonal of a marked cell, that of the margin by which triangles are thickened,
/// and half a diagonal from the cell to the surface around it.
const double kSides = std::sqrt(3) * (1 + kStepShare / 2 + 0.5);

/// The surfaces of a moving set in the assembled state.
struct MovingSurface {
  std::vector<TriangleMesh> meshes;
  Aabb box;
};

MovingSurface surface_of(const Assembly& assembly, const TimelineMove& move) {
  MovingSurface surface;
  for (const ComponentId c : move.components) {
    surface.meshes.push_back(assembled_mesh(assembly[c]));
    surface.box.extend(bounds(surface.meshes.back()));
  }
  return surface;
}

/// Poses along a move, so close that no point of the set travels further than `step` [mm] between two of them.
std::vector<Pose> close_poses(const TimelineMove& move, const Aabb& box, double step) {
  std::vector<Pose> poses{move.frames.front().pose};
  for (std::size_t i = 1; i < move.frames.size(); ++i) {
    const Pose& from = move.frames[i - 1].pose;
    const Pose& to = move.frames[i].pose;
    const Screw screw = screw_between(from, to);
    const double rho = screw_radius(screw, transform_from_pose(from) * box.center(), diagonal(box) / 2);
    const double pieces = std::max(1.0, std::ceil(screw_path_length(screw, rho) / step));
    for (double k = 1; k <= pieces; ++k) poses.push_back(pose_between(from, to, k / pieces));
  }
  return poses;
}

/// Bounds of the swept volume, enlarged by `step` [mm]. @param poses at most `step` apart
Aabb swept_bounds(const MovingSurface& surface, const std::vector<Pose>& poses, double step) {
  Aabb box;
  for (const Pose& pose : poses) {
    const RigidTransform t = transform_from_pose(pose);
    for (const TriangleMesh& mesh : surface.meshes)
      for (const Vec3& p : mesh.vertices) box.extend(t * p);
  }
  return inflated(box, step);
}

/// Marks the cells that the surface touches at a pose, with triangles thickened by half a step.
void mark_surface(const MovingSurface& surface, const Pose& pose, CellGrid& grid) {
  const RigidTransform t = transform_from_pose(pose);
  for (const TriangleMesh& mesh : surface.meshes) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      Triangle triangle = mesh.triangle(f);
      for (Vec3& corner : triangle.corner) corner = t * corner;
      grid.mark(triangle, kStepShare / 2 * grid.side());
    }
  }
}

/// Marks the cells inside of closed components: a cell that no surface passes is inside at all times or never.
void mark_inside(const Assembly& assembly, const TimelineMove& move, CellGrid& grid) {
  std::vector<SolidTree> solids;
  for (const ComponentId c : move.components)
    if (assembly[c].faults.closed()) solids.push_back(make_solid_tree(assembly[c], Executor()));
  const RigidTransform assembled = inverse(transform_from_pose(move.frames.front().pose));
  grid.mark_regions([&](const Vec3& point) {
    return std::any_of(solids.begin(), solids.end(),
                       [&](const SolidTree& solid) { return point_in_solid(solid, assembled * point); });
  });
}

Error too_fine(double tolerance) {
  char text[200];
  std::snprintf(text, sizeof text,
                "the swept volume was not computed (%g mm is too fine for its size); set a larger --within", tolerance);
  return {ErrorKind::Usage, text};
}

}  // namespace

Result<SweptVolume> swept_volume(const Assembly& assembly, const TimelineMove& move,
                                 const SweptVolumeOptions& options) {
  const MovingSurface surface = surface_of(assembly, move);
  const double coarse_step = diagonal(surface.box) / 10;
  const Aabb all = swept_bounds(surface, close_poses(move, surface.box, coarse_step), coarse_step);
  const double tolerance = options.tolerance > 0 ? options.tolerance : kSweptShare * diagonal(all);
  const double side = tolerance / kSides;
  const std::optional<CellGrid> empty = CellGrid::around(all, side, kMaxSweptCells);
  if (!empty) return too_fine(tolerance);

  CellGrid grid = *empty;
  const std::vector<Pose> poses = close_poses(move, surface.box, kStepShare * side);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!report_progress(options.progress, "sweeping", static_cast<double>(i) / static_cast<double>(poses.size())))
      return Error{ErrorKind::Failed, "the swept volume was not computed (cancelled); run it again"};
    mark_surface(surface, poses[i], grid);
  }
  mark_inside(assembly, move, grid);
  report_progress(options.progress, "sweeping", 1);
  return SweptVolume{grid.surface(), tolerance};
}

}  // namespace dismantle
