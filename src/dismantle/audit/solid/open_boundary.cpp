// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/open_boundary.h"

#include "dismantle/geometry/half_edges.h"
#include "dismantle/math/angle.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace dismantle::audit {

namespace {

/// An edge between two points of the boundary, by their indices, with its signed count of faces.
struct ChainEdge {
  std::uint32_t from = 0, to = 0;
  int count = 0;
};

/// The boundary's points, those closer together than `width` merged, in the order of x.
class BoundaryPoints {
 public:
  BoundaryPoints(const TriangleMesh& mesh, std::vector<std::uint32_t> vertices, double width) : width_(width) {
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::sort(vertices.begin(), vertices.end(), [&mesh](std::uint32_t a, std::uint32_t b) {
      return mesh.vertices[a].x != mesh.vertices[b].x ? mesh.vertices[a].x < mesh.vertices[b].x : a < b;
    });
    for (const std::uint32_t v : vertices) {
      const Vec3 p = mesh.vertices[v];
      std::uint32_t same = static_cast<std::uint32_t>(points_.size());
      for (std::size_t i = points_.size(); i-- > 0 && points_[i].x >= p.x - width;)
        if (length(points_[i] - p) <= width) same = static_cast<std::uint32_t>(i);
      if (same == points_.size()) points_.push_back(p);
      index_[v] = same;
    }
  }

  std::uint32_t index_of(std::uint32_t vertex) const { return index_.at(vertex); }
  Vec3 operator[](std::uint32_t i) const { return points_[i]; }

  /// The points on the edge between two points, in order, both included.
  std::vector<std::uint32_t> along(std::uint32_t from, std::uint32_t to) const {
    const Vec3 a = points_[from], edge = points_[to] - a;
    const double squared = dot(edge, edge), low = std::min(a.x, points_[to].x) - width_;
    std::vector<std::pair<double, std::uint32_t>> on = {{0, from}, {1, to}};
    auto it = std::lower_bound(points_.begin(), points_.end(), low, [](Vec3 p, double x) { return p.x < x; });
    for (; it != points_.end() && it->x <= std::max(a.x, points_[to].x) + width_; ++it) {
      const auto i = static_cast<std::uint32_t>(it - points_.begin());
      const double s = dot(*it - a, edge) / squared;
      if (i == from || i == to || !(s > 0 && s < 1)) continue;
      if (length(*it - (a + s * edge)) <= width_) on.emplace_back(s, i);
    }
    std::sort(on.begin(), on.end());
    std::vector<std::uint32_t> order;
    order.reserve(on.size());
    for (const auto& [s, i] : on) order.push_back(i);
    return order;
  }

 private:
  double width_;
  std::vector<Vec3> points_;
  std::map<std::uint32_t, std::uint32_t> index_;
};

/// The edges along which faces of the mesh do not cancel each other.
std::vector<ChainEdge> unbalanced_edges(const TriangleMesh& mesh) {
  std::vector<ChainEdge> edges;
  const std::vector<HalfEdge> half_edges = sorted_half_edges(mesh.faces);
  for_each_edge(half_edges, [&edges](const HalfEdge* first, const HalfEdge* last) {
    ChainEdge edge{first->low, first->high, 0};
    for (const HalfEdge* h = first; h != last; ++h) edge.count += h->forward ? 1 : -1;
    if (edge.count != 0) edges.push_back(edge);
  });
  return edges;
}

/// An angle in (-pi, pi] by a vector of any length.
struct Phasor {
  double cosine = 1, sine = 0;
};

/// Adds an angle to a sum. @return the number of full turns by which the sum is less than that, -1 to 1
double add(Phasor& sum, const Phasor& angle) {
  constexpr double kLarge = 1e100;
  Phasor p{sum.cosine * angle.cosine - sum.sine * angle.sine, sum.cosine * angle.sine + sum.sine * angle.cosine};
  const bool both_behind = sum.cosine < 0 && angle.cosine < 0;
  double turns = 0;
  if (sum.sine >= 0 && angle.sine >= 0 && (p.sine < 0 || (p.sine == 0 && both_behind))) turns = 1;
  if (sum.sine < 0 && angle.sine < 0 && p.sine >= 0) turns = -1;
  const double size = std::fabs(p.cosine) + std::fabs(p.sine);
  if (size > kLarge || size < 1 / kLarge) p = {p.cosine / size, p.sine / size};
  sum = p;
  return turns;
}

/// The way from a point to a corner of the boundary.
struct Way {
  Vec3 vector;
  double length = 0, along = 0;  // along: its component in the direction of the strips
};

Way way_to(Vec3 corner, Vec3 direction, Vec3 point) {
  const Vec3 vector = corner - point;
  return {vector, length(vector), dot(vector, direction)};
}

/// Half the solid angle of one strip of an edge, from the ways to its ends.
Phasor half_strip_angle(const Way& to, const Way& from, Vec3 direction) {
  const double cosine =
      to.length * from.length + dot(to.vector, from.vector) + from.length * to.along + to.length * from.along;
  return {cosine, dot(direction, cross(to.vector, from.vector))};
}

/// The edges in an order in which many begin where the one before ends.
std::vector<OpenEdge> in_chains(const std::vector<OpenEdge>& edges) {
  const auto before = [](Vec3 p, Vec3 q) { return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z); };
  std::map<Vec3, std::vector<std::size_t>, decltype(before)> from(before);  // edges that begin there, not taken yet
  for (std::size_t i = edges.size(); i-- > 0;) from[edges[i].from].push_back(i);
  std::vector<OpenEdge> ordered;
  std::vector<bool> taken(edges.size(), false);
  for (std::size_t first = 0; first < edges.size(); ++first) {
    if (taken[first]) continue;
    for (auto at = from.find(edges[first].from); at != from.end() && !at->second.empty();) {
      const std::size_t next = at->second.back();
      at->second.pop_back();
      taken[next] = true;
      ordered.push_back(edges[next]);
      at = from.find(edges[next].to);
    }
  }
  return ordered;
}

}  // namespace

std::vector<OpenEdge> open_boundary(const TriangleMesh& mesh) {
  const std::vector<ChainEdge> edges = unbalanced_edges(mesh);
  if (edges.empty()) return {};
  std::vector<std::uint32_t> vertices;
  for (const ChainEdge& edge : edges) vertices.insert(vertices.end(), {edge.from, edge.to});
  const BoundaryPoints points(mesh, std::move(vertices), kCrackWidth * diagonal(bounds(mesh)));

  std::map<std::pair<std::uint32_t, std::uint32_t>, int> chain;
  for (const ChainEdge& edge : edges) {
    const std::uint32_t from = points.index_of(edge.from), to = points.index_of(edge.to);
    if (from == to) continue;
    const std::vector<std::uint32_t> on = points.along(from, to);
    for (std::size_t i = 0; i + 1 < on.size(); ++i)
      chain[std::minmax(on[i], on[i + 1])] += on[i] < on[i + 1] ? edge.count : -edge.count;
  }
  std::vector<OpenEdge> open;
  for (const auto& [ends, count] : chain) {
    if (count > 0) open.push_back({points[ends.first], points[ends.second], double(count)});
    if (count < 0) open.push_back({points[ends.second], points[ends.first], double(-count)});
  }
  return in_chains(open);
}

double strip_angle(const OpenEdge& edge, Vec3 direction, Vec3 point) {
  const Phasor half =
      half_strip_angle(way_to(edge.to, direction, point), way_to(edge.from, direction, point), direction);
  return 2 * edge.count * std::atan2(half.sine, half.cosine);
}

double strip_angles(const std::vector<OpenEdge>& edges, Vec3 direction, Vec3 point) {
  Phasor sum;
  double turns = 0;
  Vec3 corner;
  Way way = way_to(corner, direction, point);
  for (const OpenEdge& edge : edges) {
    const Way from = edge.from == corner ? way : way_to(edge.from, direction, point);
    corner = edge.to;
    way = way_to(corner, direction, point);
    const Phasor half = half_strip_angle(way, from, direction);
    if (half.sine == 0 && half.cosine == 0) continue;
    for (int k = 0; k < static_cast<int>(edge.count); ++k) turns += add(sum, half);
  }
  return 2 * (kTurn * turns + std::atan2(sum.sine, sum.cosine));
}

}  // namespace dismantle::audit
