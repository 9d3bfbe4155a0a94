// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/ghost_surface.h"

#include "dismantle/geometry/aabb.h"
#include "dismantle/math/least_vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

namespace dismantle {

namespace {

/// Normals nearer to each other than this (one minus the cosine) count as one.
constexpr double kSameNormal = 1e-10;
/// Vertices no further from an edge than this share of the diagonal are on it.
constexpr double kOnEdge = 1e-4;

/// The directions in which the faces at a vertex are retracted: unit normals into the solid, and what they need.
using Inwards = std::vector<VectorBound>;

/// Calls visit(vertex, face) for vertices of open edges that lie on the inside of another one, an edge of that face:
/// T-junctions.
template <class Visit>
void for_each_vertex_on_edge(Span<const Vec3> vertices, const std::vector<HalfEdge>& open, const Visit& visit) {
  if (open.empty()) return;
  std::vector<std::uint32_t> ends;
  Aabb box;
  for (const HalfEdge& e : open)
    for (const std::uint32_t v : {e.low, e.high}) {
      ends.push_back(v);
      box.extend(vertices[v]);
    }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  const double near = kOnEdge * length(box.upper - box.lower);
  // By their coordinates along each axis: an edge looks at those beside it along the axis along which there are fewest.
  std::array<std::vector<std::uint32_t>, 3> by;
  for (int k = 0; k < 3; ++k) {
    by[k] = ends;
    std::sort(by[k].begin(), by[k].end(),
              [&](std::uint32_t a, std::uint32_t b) { return vertices[a][k] < vertices[b][k]; });
  }
  for (const HalfEdge& e : open) {
    const Vec3 from = vertices[e.low], along = vertices[e.high] - from;
    const double squared = length_squared(along);
    Span<const std::uint32_t> fewest = ends;
    for (int k = 0; k < 3; ++k) {
      const double low = std::min(from[k], from[k] + along[k]) - near,
                   high = std::max(from[k], from[k] + along[k]) + near;
      const auto begin = std::partition_point(by[k].begin(), by[k].end(), [&](auto v) { return vertices[v][k] < low; });
      const auto end = std::partition_point(begin, by[k].end(), [&](auto v) { return vertices[v][k] <= high; });
      const auto count = static_cast<std::size_t>(end - begin);
      if (count < fewest.size()) fewest = {by[k].data() + (begin - by[k].begin()), count};
    }
    for (const std::uint32_t v : fewest) {
      if (v == e.low || v == e.high) continue;
      const Vec3 off = vertices[v] - from;
      const double share = dot(off, along) / squared;
      if (share > 0 && share < 1 && length(off - share * along) <= near) visit(v, e.face);
    }
  }
}

/// The distinct ones at each vertex, gathered at the first of those at one position.
std::vector<Inwards> inwards_at_vertices(Span<const Vec3> vertices, Span<const Face> faces, Span<const double> needed,
                                         const std::vector<std::uint32_t>& first) {
  std::vector<Inwards> at(vertices.size());
  const auto add = [&](std::uint32_t vertex, std::uint32_t face) {
    const Face& f = faces[face];
    const Vec3 normal = normal_unscaled({{vertices[f.v[0]], vertices[f.v[1]], vertices[f.v[2]]}});
    const double size = length(normal);
    if (!(size > 0)) return;
    const Vec3 inwards = normal / -size;
    const double distance = needed.empty() ? 0 : needed[face];
    Inwards& bounds = at[vertex];
    const auto same = [&](const VectorBound& b) { return dot(b.normal, inwards) > 1 - kSameNormal; };
    const auto known = std::find_if(bounds.begin(), bounds.end(), same);
    if (known == bounds.end()) {
      bounds.push_back({inwards, distance});
    } else {
      known->distance = std::max(known->distance, distance);
    }
  };
  for (std::uint32_t i = 0; i < faces.size(); ++i)
    for (const std::uint32_t v : faces[i].v) add(first[v], i);
  for_each_vertex_on_edge(vertices, open_edges(faces, first), add);
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

std::vector<HalfEdge> open_edges(Span<const Face> faces, const std::vector<std::uint32_t>& first) {
  std::vector<Face> joined(faces.begin(), faces.end());
  for (Face& f : joined)
    for (std::uint32_t& v : f.v) v = first[v];
  std::vector<HalfEdge> open;
  for_each_edge(sorted_half_edges(joined), [&](const HalfEdge* begin, const HalfEdge* end) {
    if (end - begin == 1 && begin->low != begin->high) open.push_back(*begin);
  });
  return open;
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
