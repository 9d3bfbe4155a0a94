// SPDX-License-Identifier: Apache-2.0
#include "dismantle/simplify/simplify_mesh.h"

#include "dismantle/simplify/edge_collapse.h"

#include <utility>

namespace dismantle {

namespace {

// Smallest part of its volume that a solid has to keep.
constexpr double kMinVolume = 0.5;
// Factor by which the goal grows in each further attempt.
constexpr double kBackOff = 1.3;

TriangleMesh collapsed(const TriangleMesh& mesh, const SimplifyGoal& goal) {
  EdgeCollapse collapse(mesh);
  while (collapse.face_count() > goal.triangles && collapse.step(goal.error)) {
  }
  return collapse.mesh();
}

}  // namespace

TriangleMesh simplify_mesh(const TriangleMesh& mesh, const SimplifyGoal& goal) {
  const double volume = signed_volume(mesh);
  const bool solid = volume > 0 && clean_mesh(mesh).faults.closed();
  auto triangles = static_cast<double>(goal.triangles);
  while (triangles < static_cast<double>(mesh.faces.size())) {
    TriangleMesh result = collapsed(mesh, {static_cast<std::size_t>(triangles), goal.error});
    if (!solid || signed_volume(result) >= kMinVolume * volume) return result;
    triangles = kBackOff * static_cast<double>(result.faces.size()) + 1;
  }
  return mesh;
}

std::vector<SimplificationStep> simplification_curve(const TriangleMesh& mesh) {
  EdgeCollapse collapse(mesh);
  std::vector<SimplificationStep> curve{{collapse.face_count(), 0}};
  while (collapse.step()) curve.push_back({collapse.face_count(), collapse.error()});
  return curve;
}

}  // namespace dismantle
