// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/ghost_surface.h"

#include "dismantle/geometry/aabb.h"
#include "dismantle/math/least_vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace dismantle {

namespace {

/// Normals nearer to each other than this (one minus the cosine) count as one.
constexpr double kSameNormal = 1e-10;
/// Vertices no further from an edge than this share of the diagonal are on it.
constexpr double kOnEdge = 1e-4;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

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

/// The displacement of a vertex.
/// @param own the directions in which its faces are retracted: unit normals into the solid, and what they need
Vec3 displacement(std::vector<VectorBound>& own, const FaceRetractions& r) {
  constexpr double kShares[] = {1, 0.75, 0.5, 0.35, 0.2, 0.1, 0};
  const bool some_needed = std::any_of(own.begin(), own.end(), [](const VectorBound& b) { return b.distance > 0; });
  if (some_needed)
    own.erase(std::remove_if(own.begin(), own.end(), [](const VectorBound& b) { return b.distance < 0; }), own.end());
  std::vector<VectorBound> bounds = own;
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

std::vector<HalfEdge> joined_half_edges(Span<const Face> faces, const std::vector<std::uint32_t>& first) {
  std::vector<std::uint32_t> begin(first.size() + 1);
  const auto for_each_side = [&](const auto& visit) {
    for (std::uint32_t f = 0; f < faces.size(); ++f)
      for (std::uint8_t side = 0; side < 3; ++side) {
        const std::uint32_t a = first[faces[f].v[side]], b = first[faces[f].v[(side + 1) % 3]];
        if (a != b) visit(HalfEdge{std::min(a, b), std::max(a, b), f, side, a < b});
      }
  };
  for_each_side([&](const HalfEdge& e) { ++begin[e.low + 1]; });
  for (std::size_t v = 0; v < first.size(); ++v) begin[v + 1] += begin[v];
  std::vector<HalfEdge> half_edges(begin.back());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for_each_side([&](const HalfEdge& e) { half_edges[next[e.low]++] = e; });
  for (std::size_t v = 0; v < first.size(); ++v)
    std::sort(
        half_edges.begin() + begin[v], half_edges.begin() + begin[v + 1],
        [](const HalfEdge& a, const HalfEdge& b) { return a.high != b.high ? a.high < b.high : a.face < b.face; });
  return half_edges;
}

std::vector<HalfEdge> open_edges(Span<const Face> faces, const std::vector<std::uint32_t>& first) {
  std::vector<HalfEdge> open;
  for_each_edge(joined_half_edges(faces, first), [&](const HalfEdge* begin, const HalfEdge* end) {
    if (end - begin == 1) open.push_back(*begin);
  });
  return open;
}

RetractableSurface::RetractableSurface(Span<const Vec3> vertices, Span<const Face> faces)
    : vertices_(vertices.begin(), vertices.end()), first_(first_at_position(vertices)) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> on_edge;  // vertex and face
  const std::vector<HalfEdge> open = open_edges(faces, first_);
  for_each_vertex_on_edge(vertices, open, [&](std::uint32_t v, std::uint32_t f) { on_edge.emplace_back(v, f); });
  beside_open_edge_.resize(vertices.size());
  for (const HalfEdge& e : open) beside_open_edge_[e.low] = beside_open_edge_[e.high] = true;

  std::vector<std::uint32_t> begin(vertices.size() + 1);
  const auto for_each_corner = [&](const auto& visit) {
    for (std::uint32_t f = 0; f < faces.size(); ++f)
      for (const std::uint32_t v : faces[f].v) visit(first_[v], f);
    for (const auto& [v, f] : on_edge) visit(v, f);
  };
  for_each_corner([&](std::uint32_t v, std::uint32_t) { ++begin[v + 1]; });
  for (std::size_t v = 0; v < vertices.size(); ++v) begin[v + 1] += begin[v];
  std::vector<std::uint32_t> around(begin.back()), next(begin.begin(), begin.end() - 1);
  for_each_corner([&](std::uint32_t v, std::uint32_t f) { around[next[v]++] = f; });

  std::vector<Vec3> inwards(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Vec3 normal = normal_unscaled({{vertices[faces[f].v[0]], vertices[faces[f].v[1]], vertices[faces[f].v[2]]}});
    const double size = length(normal);
    if (size > 0) inwards[f] = normal / -size;
  }
  begin_.push_back(0);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    for (std::uint32_t k = begin[v]; k < begin[v + 1]; ++k) add(around[k], inwards[around[k]]);
    begin_.push_back(static_cast<std::uint32_t>(directions_.size()));
  }
}

/// Adds a face to the last vertex. @param inwards zero for a face without area
void RetractableSurface::add(std::uint32_t face, Vec3 inwards) {
  if (inwards == Vec3{}) return;
  const auto same = [&](Vec3 known) { return dot(known, inwards) > 1 - kSameNormal; };
  const auto known = std::find_if(directions_.begin() + begin_.back(), directions_.end(), same);
  directions_of_.push_back({face, static_cast<std::uint32_t>(known - directions_.begin())});
  if (known == directions_.end()) directions_.push_back(inwards);
}

std::vector<Vec3> RetractableSurface::retracted(const FaceRetractions& retractions) const {
  std::vector<double> needed(directions_.size(), retractions.needed.empty() ? 0 : -kInfinite);
  if (!retractions.needed.empty())
    for (const auto& [face, direction] : directions_of_)
      needed[direction] = std::max(needed[direction], retractions.needed[face]);
  std::vector<Vec3> displaced = vertices_;
  std::vector<VectorBound> bounds;
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    bounds.clear();
    for (std::uint32_t d = begin_[v]; d < begin_[v + 1]; ++d) bounds.push_back({directions_[d], needed[d]});
    displaced[v] = first_[v] != v ? displaced[first_[v]] : vertices_[v] + displacement(bounds, retractions);
  }
  return displaced;
}

std::vector<Vec3> ghost_vertices(Span<const Vec3> vertices, Span<const Face> faces, double max_length) {
  return RetractableSurface(vertices, faces).retracted({{}, 0, max_length / std::sqrt(2.0), max_length});
}

}  // namespace dismantle
