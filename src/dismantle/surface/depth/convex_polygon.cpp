// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/depth/convex_polygon.h"

#include <algorithm>
#include <utility>

namespace dismantle {

namespace {

// Smallest part of a piece's size that a cut has to separate.
constexpr double kMinCut = 1e-9;

/// The parts of a convex polygon on the two sides of a plane, and their extents from it.
struct CutPolygon {
  ConvexPolygon within, beyond;
  double reach_within = 0, reach_beyond = 0;

  bool proper(double size) const { return std::min(reach_within, reach_beyond) > kMinCut * size; }
};

/// @param normal unit length; `within` is dot(normal, x) <= offset
CutPolygon cut(const ConvexPolygon& polygon, Vec3 normal, double offset) {
  CutPolygon parts;
  parts.within.reserve(polygon.size() + 1);
  parts.beyond.reserve(polygon.size() + 1);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double beyond_a = dot(normal, a) - offset, beyond_b = dot(normal, b) - offset;
    parts.reach_within = std::max(parts.reach_within, -beyond_a);
    parts.reach_beyond = std::max(parts.reach_beyond, beyond_a);
    if (beyond_a <= 0) parts.within.push_back(a);
    if (beyond_a >= 0) parts.beyond.push_back(a);
    if (!((beyond_a < 0 && beyond_b > 0) || (beyond_a > 0 && beyond_b < 0))) continue;
    const Vec3 crossing = a + beyond_a / (beyond_a - beyond_b) * (b - a);
    parts.within.push_back(crossing);
    parts.beyond.push_back(crossing);
  }
  return parts;
}

Vec3 farthest_from(Vec3 point, const ConvexPolygon& polygon) {
  return *std::max_element(polygon.begin(), polygon.end(),
                           [&](Vec3 a, Vec3 b) { return length_squared(a - point) < length_squared(b - point); });
}

}  // namespace

Vec3 centroid_of(const ConvexPolygon& polygon) {
  Vec3 sum;
  for (const Vec3& p : polygon) sum += p;
  return sum / static_cast<double>(polygon.size());
}

double radius_about(const ConvexPolygon& polygon, Vec3 center) {
  return length(farthest_from(center, polygon) - center);
}

ConvexPolygon scaled_about(const ConvexPolygon& polygon, Vec3 center, double scale) {
  ConvexPolygon scaled;
  scaled.reserve(polygon.size());
  for (const Vec3& p : polygon) scaled.push_back(center + scale * (p - center));
  return scaled;
}

std::vector<ConvexPolygon> divided(const ConvexPolygon& piece, const Triangle& below) {
  const Vec3 up = normal_unscaled(below);
  const Vec3 middle = centroid_of(piece);
  const double size = radius_about(piece, middle);
  std::vector<ConvexPolygon> parts;
  ConvexPolygon main = piece;
  for (int k = 0; k < 3; ++k) {
    const Vec3 outwards = normalized(cross(below[(k + 1) % 3] - below[k], up));
    const double offset = dot(outwards, below[k]);
    CutPolygon sides = cut(main, outwards, offset);
    if (!sides.proper(size)) continue;
    const bool middle_within = dot(outwards, middle) <= offset;
    main = std::move(middle_within ? sides.within : sides.beyond);
    parts.push_back(std::move(middle_within ? sides.beyond : sides.within));
  }
  if (parts.empty()) return halved(piece);
  if (!main.empty()) parts.push_back(std::move(main));
  return parts;
}

std::vector<ConvexPolygon> divided_by_plane(const ConvexPolygon& piece, const Triangle& across) {
  const Vec3 normal = normalized(normal_unscaled(across));
  CutPolygon sides = cut(piece, normal, dot(normal, across[0]));
  if (!sides.proper(radius_about(piece, centroid_of(piece)))) return divided(piece, across);
  return {std::move(sides.within), std::move(sides.beyond)};
}

std::vector<ConvexPolygon> divided_between(const ConvexPolygon& piece, const Triangle& first, const Triangle& second) {
  const Vec3 middle = centroid_of(piece);
  Vec3 normals[2] = {normalized(normal_unscaled(first)), normalized(normal_unscaled(second))};
  if (dot(normals[0], middle - first[0]) < 0) normals[0] = -normals[0];
  if (dot(normals[1], middle - second[0]) < 0) normals[1] = -normals[1];
  const Vec3 across = normals[0] - normals[1];
  const double size = length(across);
  if (!(size > kMinCut)) return divided(piece, first);
  const double offset = (dot(normals[0], first[0]) - dot(normals[1], second[0])) / size;
  CutPolygon sides = cut(piece, across / size, offset);
  if (!sides.proper(radius_about(piece, middle))) return divided(piece, first);
  return {std::move(sides.within), std::move(sides.beyond)};
}

std::vector<ConvexPolygon> halved(const ConvexPolygon& piece) {
  const Vec3 middle = centroid_of(piece);
  const Vec3 along = normalized(farthest_from(middle, piece) - middle);
  CutPolygon halves = cut(piece, along, dot(along, middle));
  std::vector<ConvexPolygon> parts;
  if (!halves.within.empty()) parts.push_back(std::move(halves.within));
  if (!halves.beyond.empty()) parts.push_back(std::move(halves.beyond));
  return parts;
}

}  // namespace dismantle
