// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/sheet_sides.h"

#include "dismantle/certificates/ghosts/displaced_faces.h"

#include <cmath>
#include <utility>

namespace dismantle {

namespace {

bool is_sheet(const SolidTree& tree) {
  return !tree.has_outside && !tree.inside_out;
}

std::vector<Vec3> mirrored(const std::vector<Vec3>& displaced, const std::vector<Vec3>& vertices) {
  std::vector<Vec3> mirrored = vertices;
  for (std::size_t v = 0; v < mirrored.size(); ++v) mirrored[v] += vertices[v] - displaced[v];
  return mirrored;
}

}  // namespace

bool SheetSides::begin_motion(bool assembled, const RigidTransform& end, double tolerance) {
  if (!both) return false;
  decided |= !assembled;
  const bool before = mirrored;
  if (!decided) mirrored = needs_mirrored(end, tolerance);
  return mirrored != before;
}

bool SheetSides::jump(bool assembled, const RigidTransform& at, double tolerance) {
  if (!both) return false;
  // Nearer than that, the ghosts of both sides may be apart; those with which the two got there stay in use.
  const bool is_clear = std::abs(offset(at)) > tolerance;
  const bool before = mirrored;
  if (assembled || is_clear || !decided) mirrored = needs_mirrored(at, tolerance);
  decided = !assembled;
  return mirrored != before;
}

std::optional<MirroredGhosts> mirrored_ghosts(const PairGhostRequest& request, const PairGhosts& ghosts) {
  if (!is_sheet(*request.a.tree) || !is_sheet(*request.b.tree)) return std::nullopt;
  const OverlapSide* sides[] = {&request.a, &request.b};
  MirroredGhosts found;
  for (const std::size_t k : {0, 1}) {
    const OverlapSide &own = *sides[k], &other = *sides[1 - k];
    if (ghosts.vertices[k].empty()) return std::nullopt;
    found.vertices[k] = mirrored(ghosts.vertices[k], own.tree->vertices);
    if (!DisplacedFaces(own, other, request.tolerance).apart(found.vertices[k], true)) return std::nullopt;
  }
  const std::vector<Vec3>& vertices = request.a.tree->vertices;
  Vec3 sum, way;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    sum += vertices[v];
    way += ghosts.vertices[0][v] - vertices[v];
  }
  if (!(length(way) > 0)) return std::nullopt;
  found.sides = {true, sum / static_cast<double>(vertices.size()), normalized(way)};
  return found;
}

}  // namespace dismantle
