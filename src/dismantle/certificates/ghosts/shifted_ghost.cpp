// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/shifted_ghost.h"

#include "dismantle/narrowphase/distance_triangle_triangle.h"

#include <algorithm>
#include <limits>

namespace dismantle {

namespace {

/// A shift is to be free from this share of its way on; the second one for surfaces that overlap.
constexpr double kShiftBegins[] = {0.02, 0.9};
/// So many directions are tried, of those that lead to the right side by at least this cosine.
constexpr std::size_t kMaxDirections = 12;
constexpr double kSameSide = 0.05;

/// The way off the nearest face of the other surface, unit; zero where surfaces touch.
Vec3 away_from_nearest(const ShiftRequest& request) {
  TriangleDistance nearest;
  nearest.distance = std::numeric_limits<double>::infinity();
  for (const auto& [face_own, face_other] : *request.near) {
    const TriangleDistance found =
        distance_triangle_triangle(request.own->triangle(face_own), request.other->triangle(face_other));
    if (found.distance < nearest.distance) nearest = found;
  }
  return request.near->empty() ? Vec3{} : normalized(nearest.point_a - nearest.point_b);
}

/// Directions in which a surface may come off the other one: normals of faces that touch or intersect, and the mean of
/// displacements to the right side, or, where nothing is displaced, the way off what is nearest.
std::vector<Vec3> directions_off(const ShiftRequest& request) {
  Vec3 sum;
  for (std::size_t i = 0; i < request.off.size(); ++i) sum += request.off[i] - request.own->vertices[i];
  if (length(sum) == 0 && !request.off.empty()) {
    sum = away_from_nearest(request);
    if (length(sum) == 0) return {};
  }
  std::vector<Vec3> directions;
  const auto add_one = [&](Vec3 d) {
    const auto same = [&](Vec3 known) { return dot(known, d) > 1 - 1e-6; };
    if (directions.size() < kMaxDirections && std::none_of(directions.begin(), directions.end(), same))
      directions.push_back(d);
  };
  const auto add = [&](Vec3 d) {
    const double along = dot(d, sum), enough = kSameSide * length(sum);
    if (along >= enough) add_one(d);
    if (along <= -enough) add_one(-d);
  };
  for (const auto& [face_own, face_other] : *request.near) {
    const Triangle own = request.own->triangle(face_own), other = request.other->triangle(face_other);
    if (distance_triangle_triangle(own, other).distance > request.touching) continue;
    add(normalized(normal_unscaled(own)));
    add(normalized(normal_unscaled(other)));
  }
  if (length(sum) > 0) add(normalized(sum));
  return directions;
}

}  // namespace

std::optional<std::vector<Vec3>> shifted_ghost(const ShiftRequest& request) {
  const std::vector<Vec3>& vertices = request.own->vertices;
  const std::vector<Vec3> directions = directions_off(request);
  for (const double way : request.lengths)
    for (const double begin : kShiftBegins)
      for (const Vec3& direction : directions) {
        const Vec3 shift = way * direction;
        if (!request.displaced->free(vertices, begin * shift, shift)) continue;
        std::vector<Vec3> shifted = vertices;
        for (Vec3& p : shifted) p += shift;
        if (!request.may_contain || !request.displaced->contained(shifted)) return shifted;
      }
  return std::nullopt;
}

}  // namespace dismantle
