// SPDX-License-Identifier: Apache-2.0
#include "dismantle/simplify/edge_collapse.h"

#include "dismantle/geometry/half_edges.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace dismantle {

namespace {

// Weight of the plane through a border edge perpendicular to its triangle, which keeps the border's shape.
constexpr double kBorderWeight = 10;
// Cosine of the largest angle by which a triangle's normal may turn in one collapse.
constexpr double kMinTurnCosine = 0.2;
// A collapse may not make a triangle's height fall below this part of its longest side.
constexpr double kMinThickness = 1e-3;

bool contains(const Face& face, std::uint32_t vertex) {
  return face.v[0] == vertex || face.v[1] == vertex || face.v[2] == vertex;
}

/// Height over the longest side relative to that side.
double thickness(const Triangle& t) {
  const double longest =
      std::max({length_squared(t[1] - t[0]), length_squared(t[2] - t[1]), length_squared(t[0] - t[2])});
  return longest > 0 ? length(normal_unscaled(t)) / longest : 0;
}

}  // namespace

EdgeCollapse::EdgeCollapse(const TriangleMesh& mesh)
    : original_(mesh.vertices),
      faces_(mesh.faces),
      face_alive_(mesh.faces.size(), true),
      faces_of_(mesh.vertices.size()),
      quadrics_(mesh.vertices.size()),
      versions_(mesh.vertices.size(), 0),
      on_border_(mesh.vertices.size(), false),
      locked_(mesh.vertices.size(), false),
      face_count_(mesh.faces.size()) {
  const Aabb box = bounds(mesh);
  positions_.reserve(original_.size());
  for (const Vec3& p : original_) positions_.push_back(p - box.center());
  for (std::uint32_t f = 0; f < faces_.size(); ++f)
    for (const std::uint32_t v : faces_[f].v) faces_of_[v].push_back(f);
  add_face_quadrics();
  add_edge_quadrics();
  for (std::uint32_t v = 0; v < faces_of_.size(); ++v)
    for (const std::uint32_t w : neighbours(v)) push(v, w);
}

Triangle EdgeCollapse::triangle(const Face& face) const {
  return {{positions_[face.v[0]], positions_[face.v[1]], positions_[face.v[2]]}};
}

void EdgeCollapse::add_face_quadrics() {
  for (const Face& face : faces_) {
    const Triangle t = triangle(face);
    const Quadric q = plane_quadric(normalized(normal_unscaled(t)), t[0], 1);
    for (const std::uint32_t v : face.v) quadrics_[v] += q;
  }
}

/// Finds borders and non-manifold edges, and adds the planes of the borders.
void EdgeCollapse::add_edge_quadrics() {
  for_each_edge(sorted_half_edges(faces_), [&](const HalfEdge* first, const HalfEdge* last) {
    const std::uint32_t ends[2] = {first->low, first->high};
    const bool border = last - first == 1;
    const bool manifold = border || (last - first == 2 && first[0].forward != first[1].forward);
    if (manifold && !border) return;
    const Vec3 along = positions_[ends[1]] - positions_[ends[0]];
    const Vec3 across = normalized(cross(along, normal_unscaled(triangle(faces_[first->face]))));
    for (const std::uint32_t v : ends) {
      if (!manifold) locked_[v] = true;
      if (border) on_border_[v] = true;
      if (border) quadrics_[v] += plane_quadric(across, positions_[v], kBorderWeight);
    }
  });
}

std::vector<std::uint32_t> EdgeCollapse::neighbours(std::uint32_t vertex) const {
  std::vector<std::uint32_t> around;
  for (const std::uint32_t f : faces_of_[vertex])
    for (const std::uint32_t v : faces_[f].v)
      if (v != vertex) around.push_back(v);
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  return around;
}

void EdgeCollapse::push(std::uint32_t from, std::uint32_t to) {
  if (locked_[from]) return;
  Quadric sum = quadrics_[from];
  sum += quadrics_[to];
  queue_.push({evaluate(sum, positions_[to]), from, to, versions_[from], versions_[to]});
}

bool EdgeCollapse::keeps_topology(std::uint32_t from, std::uint32_t to) const {
  std::vector<std::uint32_t> opposite;
  for (const std::uint32_t f : faces_of_[from])
    if (contains(faces_[f], to))
      for (const std::uint32_t v : faces_[f].v)
        if (v != from && v != to) opposite.push_back(v);
  std::sort(opposite.begin(), opposite.end());
  const std::size_t required = on_border_[from] ? 1 : 2;  // a border vertex moves along its border only
  if (opposite.size() != required || face_count_ <= 4) return false;

  const std::vector<std::uint32_t> a = neighbours(from), b = neighbours(to);
  std::vector<std::uint32_t> common;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
  if (common != opposite) return false;
  // A tetrahedron, alone or at the end of a chain, would become two triangles back to back.
  return on_border_[from] || a.size() > 3 || b.size() > 3;
}

bool EdgeCollapse::keeps_shape(std::uint32_t from, std::uint32_t to) const {
  for (const std::uint32_t f : faces_of_[from]) {
    if (contains(faces_[f], to)) continue;
    Face moved = faces_[f];
    for (std::uint32_t& v : moved.v) v = v == from ? to : v;
    const Triangle before = triangle(faces_[f]), after = triangle(moved);
    const Vec3 n = normal_unscaled(before), m = normal_unscaled(after);
    const Triangle exact{{original_[moved.v[0]], original_[moved.v[1]], original_[moved.v[2]]}};
    if (normal_unscaled(exact) == Vec3{} || m == Vec3{}) return false;
    if (dot(n, m) < kMinTurnCosine * length(n) * length(m)) return false;
    const double thickness_after = thickness(after);
    if (thickness_after < kMinThickness && thickness_after < thickness(before)) return false;
  }
  return true;
}

void EdgeCollapse::collapse(std::uint32_t from, std::uint32_t to) {
  for (const std::uint32_t f : faces_of_[from]) {
    if (contains(faces_[f], to)) {
      face_alive_[f] = false;
      --face_count_;
      for (const std::uint32_t v : faces_[f].v) {
        if (v == from) continue;
        auto& list = faces_of_[v];
        list.erase(std::find(list.begin(), list.end(), f));
      }
      continue;
    }
    for (std::uint32_t& v : faces_[f].v) v = v == from ? to : v;
    faces_of_[to].push_back(f);
  }
  faces_of_[from].clear();
  quadrics_[to] += quadrics_[from];
  ++versions_[from];
  ++versions_[to];
}

bool EdgeCollapse::step(double error_limit) {
  while (!queue_.empty()) {
    const Candidate c = queue_.top();
    if (std::sqrt(c.cost) > error_limit) return false;
    queue_.pop();
    if (c.version_from != versions_[c.from] || c.version_to != versions_[c.to]) continue;
    if (!keeps_topology(c.from, c.to) || !keeps_shape(c.from, c.to)) continue;
    collapse(c.from, c.to);
    error_ = std::max(error_, std::sqrt(c.cost));
    for (const std::uint32_t w : neighbours(c.to)) {
      push(c.to, w);
      push(w, c.to);
    }
    return true;
  }
  return false;
}

TriangleMesh EdgeCollapse::mesh() const {
  TriangleMesh result;
  std::vector<std::uint32_t> new_index(original_.size(), 0xffffffffu);
  for (std::uint32_t v = 0; v < original_.size(); ++v) {
    if (faces_of_[v].empty()) continue;
    new_index[v] = static_cast<std::uint32_t>(result.vertices.size());
    result.vertices.push_back(original_[v]);
  }
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (!face_alive_[f]) continue;
    Face face = faces_[f];
    for (std::uint32_t& v : face.v) v = new_index[v];
    result.faces.push_back(face);
  }
  return result;
}

}  // namespace dismantle
