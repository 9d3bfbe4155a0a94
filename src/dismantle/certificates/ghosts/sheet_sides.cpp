// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/sheet_sides.h"

#include "dismantle/certificates/ghosts/displaced_faces.h"

#include <cmath>

namespace dismantle {

namespace {

/// The way to a mirror image is to be free from this share on: a sheet that is on one side already has no choice.
constexpr double kBegin = 0.02;
/// Displacements that differ by less than this share are the same.
constexpr double kRounding = 1e-6;

/// The displacement of all vertices, if it is the same.
std::optional<Vec3> common_shift(const std::vector<Vec3>& displaced, const std::vector<Vec3>& vertices) {
  if (displaced.empty()) return std::nullopt;
  const Vec3 shift = displaced[0] - vertices[0];
  for (std::size_t v = 0; v < vertices.size(); ++v)
    if (length(displaced[v] - vertices[v] - shift) > kRounding * length(shift)) return std::nullopt;
  return length(shift) > 0 ? std::optional(shift) : std::nullopt;
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
  if (!request.a.is_sheet() || !request.b.is_sheet()) return std::nullopt;
  const OverlapSide* sides[] = {&request.a, &request.b};
  MirroredGhosts found;
  for (const std::size_t k : {0, 1}) {
    const std::vector<Vec3>& vertices = sides[k]->tree->vertices;
    const std::optional<Vec3> shift = common_shift(ghosts.vertices[k], vertices);
    if (!shift) return std::nullopt;
    const DisplacedFaces faces(*sides[k], *sides[1 - k], request.tolerance);
    if (!faces.free(vertices, -kBegin * *shift, -*shift)) return std::nullopt;
    for (const Vec3& p : vertices) found.vertices[k].push_back(p - *shift);
    if (!faces.apart(found.vertices[k], true)) return std::nullopt;
    if (k == 0) found.sides.direction = normalized(*shift);
  }
  Vec3 sum;
  for (const Vec3& p : request.a.tree->vertices) sum += p;
  found.sides.point = sum / static_cast<double>(request.a.tree->vertices.size());
  found.sides.both = true;
  return found;
}

}  // namespace dismantle
