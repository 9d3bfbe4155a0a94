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

/// The distinct unit normals of the faces at each vertex, gathered at the first of those at one position.
std::vector<std::vector<VectorBound>> retractions(Span<const Vec3> vertices, Span<const Face> faces,
                                                  const std::vector<std::uint32_t>& first) {
  std::vector<std::vector<VectorBound>> at(vertices.size());
  for (const Face& f : faces) {
    const Vec3 normal = normal_unscaled({{vertices[f.v[0]], vertices[f.v[1]], vertices[f.v[2]]}});
    const double size = length(normal);
    if (!(size > 0)) continue;
    const Vec3 inwards = normal / -size;
    for (const std::uint32_t v : f.v) {
      std::vector<VectorBound>& bounds = at[first[v]];
      const auto same = [&](const VectorBound& b) { return dot(b.normal, inwards) > 1 - kSameNormal; };
      if (std::none_of(bounds.begin(), bounds.end(), same)) bounds.push_back({inwards, 1});
    }
  }
  return at;
}

}  // namespace

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

std::vector<Vec3> ghost_vertices(Span<const Vec3> vertices, Span<const Face> faces, double max_length) {
  const std::vector<std::uint32_t> first = first_at_position(vertices);
  const std::vector<std::vector<VectorBound>> bounds = retractions(vertices, faces, first);
  std::vector<Vec3> displaced(vertices.begin(), vertices.end());
  const double distance = max_length / std::sqrt(2.0);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (first[v] != v) {
      displaced[v] = displaced[first[v]];
    } else if (const std::optional<Vec3> least = least_vector(bounds[v]); least && length(*least) > 0) {
      displaced[v] += std::min(distance, max_length / length(*least)) * *least;
    }
  }
  return displaced;
}

}  // namespace dismantle
