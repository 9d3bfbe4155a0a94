// SPDX-License-Identifier: Apache-2.0
#include "dismantle/geometry/round_axes.h"

#include "dismantle/geometry/aabb.h"
#include "dismantle/geometry/adjacency.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

namespace dismantle {

namespace {

constexpr double kQuarterTurn = 1.5707963;
/// Faces that meet at less [sine] are taken for one plane; at more [cosine] for a corner.
constexpr double kLeastSine = 1e-4;
constexpr double kLeastCosine = 0.5;
/// Axes agree whose directions and places are in one cell of that size; places as a share of the box's diagonal.
constexpr double kSameDirection = 1e-3;
constexpr double kSamePlace = 1e-4;
/// Where cells begin: not at places that models are fond of.
constexpr double kCellOffset = 0.3819660113;

using Cell = std::array<std::int64_t, 6>;

std::int64_t cell_at(double x, double size) {
  return static_cast<std::int64_t>(std::floor(x / size + kCellOffset));
}

/// The one of both signs whose largest coordinate is positive.
Vec3 of_one_sign(Vec3 v) {
  const double x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
  const double largest = x >= y && x >= z ? v.x : y >= z ? v.y : v.z;
  return largest < 0 ? -v : v;
}

/// The third corner of a face.
Vec3 opposite(Span<const Vec3> vertices, const Face& face, const std::uint32_t (&edge)[2]) {
  for (const std::uint32_t v : face.v)
    if (v != edge[0] && v != edge[1]) return vertices[v];
  return vertices[edge[0]];
}

Vec3 normal_of(Span<const Vec3> vertices, const Face& f) {
  return normalized(normal_unscaled(Triangle{{vertices[f.v[0]], vertices[f.v[1]], vertices[f.v[2]]}}));
}

/// The axis of which the edge of two faces is a ruling; a turn of zero where there is none.
RoundAxis axis_of(Span<const Vec3> vertices, Span<const Face> faces, const NeighbouringFaces& pair, Vec3 middle) {
  RoundAxis axis;
  const Face &a = faces[pair.face[0]], &b = faces[pair.face[1]];
  const Vec3 normal_a = normal_of(vertices, a), normal_b = normal_of(vertices, b);
  const double sine = length(cross(normal_a, normal_b));
  if (!(sine > kLeastSine) || !(dot(normal_a, normal_b) > kLeastCosine)) return axis;
  const Vec3 from = vertices[pair.edge[0]];
  axis.direction = of_one_sign(normalized(vertices[pair.edge[1]] - from));
  const auto across = [&](Vec3 v) { return v - dot(v, axis.direction) * axis.direction; };
  // The center of the circle through the edge and the two opposite corners, seen along the edge.
  const Vec3 p = across(opposite(vertices, a, pair.edge) - from), q = across(opposite(vertices, b, pair.edge) - from);
  const Vec3 normal = cross(p, q);
  const double square = length_squared(normal);
  if (!(square > 0)) return axis;
  const Vec3 center = from + cross(length_squared(p) * q - length_squared(q) * p, normal) / (2 * square);
  axis.point = middle + across(center - middle);
  axis.turn = std::asin(std::min(1.0, sine));
  return axis;
}

}  // namespace

std::vector<RoundAxis> round_axes(Span<const Vec3> vertices, Span<const Face> faces) {
  Aabb box;
  for (const Vec3& p : vertices) box.extend(p);
  if (box.empty()) return {};
  const Vec3 middle = box.center();
  const double diagonal = length(box.size());
  std::map<Cell, RoundAxis> cells;  // sums, weighted by the turn
  for (const NeighbouringFaces& pair : neighbouring_faces(faces)) {
    const RoundAxis axis = axis_of(vertices, faces, pair, middle);
    const Vec3 place = axis.point - middle, d = axis.direction;
    if (!(axis.turn > 0) || !(max_abs(place) <= diagonal)) continue;
    const double size = kSamePlace * diagonal;
    RoundAxis& sum = cells[{cell_at(d.x, kSameDirection), cell_at(d.y, kSameDirection), cell_at(d.z, kSameDirection),
                            cell_at(place.x, size), cell_at(place.y, size), cell_at(place.z, size)}];
    sum.point += axis.turn * place;
    sum.direction += axis.turn * d;
    sum.turn += axis.turn;
  }
  std::vector<RoundAxis> axes;
  for (const auto& [cell, sum] : cells)
    if (sum.turn >= kQuarterTurn) axes.push_back({middle + sum.point / sum.turn, normalized(sum.direction), sum.turn});
  std::stable_sort(axes.begin(), axes.end(), [](const RoundAxis& x, const RoundAxis& y) { return x.turn > y.turn; });
  if (axes.size() > kMostRoundAxes) axes.resize(kMostRoundAxes);
  return axes;
}

}  // namespace dismantle
