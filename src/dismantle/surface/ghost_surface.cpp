// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/ghost_surface.h"

#include "dismantle/math/least_vector.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace dismantle {

namespace {

/// Normals nearer to each other than this (one minus the cosine) count as one.
constexpr double kSameNormal = 1e-10;

/// The directions in which the faces at a vertex are retracted: unit normals into the solid, and what they need.
using Inwards = std::vector<VectorBound>;

/// The distinct ones at each vertex, gathered at the first of those at one position.
std::vector<Inwards> inwards_at_vertices(Span<const Vec3> vertices, Span<const Face> faces, Span<const double> needed,
                                         const std::vector<std::uint32_t>& first) {
  std::vector<Inwards> at(vertices.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Face& f = faces[i];
    const Vec3 normal = normal_unscaled({{vertices[f.v[0]], vertices[f.v[1]], vertices[f.v[2]]}});
    const double size = length(normal);
    if (!(size > 0)) continue;
    const Vec3 inwards = normal / -size;
    const double distance = needed.empty() ? 0 : needed[i];
    for (const std::uint32_t v : f.v) {
      Inwards& bounds = at[first[v]];
      const auto same = [&](const VectorBound& b) { return dot(b.normal, inwards) > 1 - kSameNormal; };
      const auto known = std::find_if(bounds.begin(), bounds.end(), same);
      if (known == bounds.end()) {
        bounds.push_back({inwards, distance});
      } else {
        known->distance = std::max(known->distance, distance);
      }
    }
  }
  return at;
}

/// The displacement of a vertex.
Vec3 displacement(const Inwards& inwards, const FaceRetractions& r) {
  constexpr double kShares[] = {1, 0.75, 0.5, 0.35, 0.2, 0.1, 0};
  const bool some_needed =
      std::any_of(inwards.begin(), inwards.end(), [](const VectorBound& b) { return b.distance > 0; });
  Inwards bounds;
  for (const VectorBound& b : inwards)
    if (!some_needed || b.distance >= 0) bounds.push_back(b);
  const Inwards own = bounds;
  Vec3 longest;
  for (const double share : kShares) {
    double scale = 0;
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      bounds[i].distance = own[i].distance > 0 ? own[i].distance + share * r.extra : share * r.usual;
      scale = std::max(scale, bounds[i].distance);
    }
    if (!(scale > 0)) return {};
    for (VectorBound& bound : bounds) bound.distance /= scale;
    const std::optional<Vec3> least = least_vector(bounds);
    if (!least || !(length(*least) > 0)) return {};
    longest = scale * *least;
    if (length(longest) <= r.max_length || !some_needed) break;
  }
  return std::min(1.0, r.max_length / length(longest)) * longest;
}

}  // namespace

std::vector<Face> outward_faces(Span<const Face> faces, bool inside_out) {
  std::vector<Face> outward(faces.begin(), faces.end());
  if (inside_out)
    for (Face& f : outward) std::swap(f.v[1], f.v[2]);
  return outward;
}

std::vector<std::uint32_t> first_at_position(Span<const Vec3> vertices) {
  std::vector<std::uint32_t> order(vertices.size()), first(vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) { return std::tuple(vertices[i].x, vertices[i].y, vertices[i].z); };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t i, std::uint32_t j) { return key(i) != key(j) ? key(i) < key(j) : i < j; });
  for (std::size_t k = 0; k < order.size(); ++k)
    first[order[k]] = k > 0 && key(order[k - 1]) == key(order[k]) ? first[order[k - 1]] : order[k];
  return first;
}

std::vector<Vec3> retracted_vertices(Span<const Vec3> vertices, Span<const Face> faces,
                                     const FaceRetractions& retractions) {
  const std::vector<std::uint32_t> first = first_at_position(vertices);
  const std::vector<Inwards> inwards = inwards_at_vertices(vertices, faces, retractions.needed, first);
  std::vector<Vec3> displaced(vertices.begin(), vertices.end());
  for (std::size_t v = 0; v < vertices.size(); ++v)
    displaced[v] = first[v] != v ? displaced[first[v]] : vertices[v] + displacement(inwards[v], retractions);
  return displaced;
}

std::vector<Vec3> ghost_vertices(Span<const Vec3> vertices, Span<const Face> faces, double max_length) {
  return retracted_vertices(vertices, faces, {{}, 0, max_length / std::sqrt(2.0), max_length});
}

}  // namespace dismantle
