// SPDX-License-Identifier: Apache-2.0
#include "bench/families/oracle_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace dismantle::families {

namespace {

constexpr std::uint32_t kLeafFaces = 4;
/// Nodes further away than so many radii count as a dipole.
constexpr double kFar = 2.2;

double squared_to_box(const Aabb& box, Vec3 p) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double d = std::max({0.0, box.lower[k] - p[k], p[k] - box.upper[k]});
    sum += d * d;
  }
  return sum;
}

bool segment_may_meet(const Aabb& box, Vec3 from, Vec3 step) {
  double enter = 0, leave = 1;
  for (int k = 0; k < 3; ++k) {
    if (step[k] == 0) {
      if (from[k] < box.lower[k] || from[k] > box.upper[k]) return false;
      continue;
    }
    double s = (box.lower[k] - from[k]) / step[k], t = (box.upper[k] - from[k]) / step[k];
    if (s > t) std::swap(s, t);
    enter = std::max(enter, s - 1e-9 * (1 + std::abs(s)));
    leave = std::min(leave, t + 1e-9 * (1 + std::abs(t)));
  }
  return enter <= leave;
}

/// By the region that the point projects to (Ericson, Real-Time Collision Detection, 5.1.5).
Vec3 nearest_of_triangle(const Triangle& t, Vec3 p) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0], bp = p - t[1], cp = p - t[2];
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
               d6 = dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return t[0];
  if (d3 >= 0 && d4 <= d3) return t[1];
  if (d6 >= 0 && d5 <= d6) return t[2];
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return t[0] + (d1 / (d1 - d3)) * ab;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return t[0] + (d2 / (d2 - d6)) * ac;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return t[1] + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (t[2] - t[1]);
  const Vec3 n = cross(ab, ac);
  return p - (dot(ap, n) / dot(n, n)) * n;
}

bool before(Vec3 a, Vec3 b) {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// The side on which the line from `p` along `d` passes an edge; exactly opposite for the edge turned round.
double side_of_edge(Vec3 p, Vec3 d, Vec3 u, Vec3 v) {
  if (before(v, u)) return -side_of_edge(p, d, v, u);
  return dot(d, cross(u - p, v - p));
}

bool meets(const Triangle& t, Vec3 from, Vec3 to) {
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  const double a = dot(from - t[0], n), b = dot(to - t[0], n);
  if ((a > 0 && b > 0) || (a < 0 && b < 0)) return false;
  const Vec3 d = to - from;
  const double s[] = {side_of_edge(from, d, t[0], t[1]), side_of_edge(from, d, t[1], t[2]),
                      side_of_edge(from, d, t[2], t[0])};
  return (s[0] >= 0 && s[1] >= 0 && s[2] >= 0) || (s[0] <= 0 && s[1] <= 0 && s[2] <= 0);
}

double solid_angle(const Triangle& t, Vec3 p) {
  const Vec3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
  const double x = length(a), y = length(b), z = length(c);
  return 2 * std::atan2(dot(a, cross(b, c)), x * y * z + dot(a, b) * z + dot(b, c) * x + dot(c, a) * y);
}

/// Offsets from a face's center at which winding numbers tell a solid from a sheet, as a share of the diagonal.
constexpr double kOffset = 1e-6;
constexpr std::size_t kFacesTried = 60;
/// Mean of the larger magnitude of the two winding numbers beside a face: 1 for a solid, 1/2 for a sheet.
constexpr double kSolid = 0.8;

}  // namespace

OracleMesh::OracleMesh(TriangleMesh mesh, bool solid, bool simple)
    : mesh_(std::move(mesh)), order_(mesh_.faces.size()), solid_(solid), simple_(simple) {
  std::iota(order_.begin(), order_.end(), 0u);
  for (const Vec3& p : mesh_.vertices) radius_ = std::max(radius_, length(p));
  for (std::size_t f = 0; f < order_.size(); ++f) normals_.push_back(normalized(normal_unscaled(mesh_.triangle(f))));
  nodes_.reserve(2 * order_.size() + 1);
  build(0, static_cast<std::uint32_t>(order_.size()));
}

std::uint32_t OracleMesh::build(std::uint32_t first, std::uint32_t count) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Node node;
  node.first = first;
  node.count = count;
  sum_up(node);
  nodes_.push_back(node);
  if (count <= kLeafFaces) return index;
  const Vec3 size = node.box.upper - node.box.lower;
  const int k = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  const auto key = [&](std::uint32_t f) {
    const Triangle t = mesh_.triangle(f);
    return t[0][k] + t[1][k] + t[2][k];
  };
  const std::uint32_t half = count / 2;
  std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count,
                   [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  const std::uint32_t left = build(first, half), right = build(first + half, count - half);
  nodes_[index].left = left;
  nodes_[index].right = right;
  return index;
}

void OracleMesh::sum_up(Node& node) const {
  double weight = 0;
  for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
    const Triangle t = mesh_.triangle(order_[i]);
    for (const Vec3& p : t.corner) node.box.extend(p);
    const Vec3 area = cross(t[1] - t[0], t[2] - t[0]) / 2;
    node.area = node.area + area;
    node.center = node.center + length(area) / 3 * (t[0] + t[1] + t[2]);
    weight += length(area);
  }
  if (weight > 0) node.center = node.center / weight;
  for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
    for (const std::uint32_t v : mesh_.faces[order_[i]].v)
      node.radius = std::max(node.radius, length(mesh_.vertices[v] - node.center));
}

NearestFace OracleMesh::nearest(Vec3 point, double limit) const {
  NearestFace best;
  best.distance = limit;
  double squared = limit * limit;
  std::uint32_t stack[64];
  int size = 0;
  stack[size++] = 0;
  bool found = false;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    if (squared_to_box(node.box, point) >= squared) continue;
    if (node.left == 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        const Triangle t = mesh_.triangle(order_[i]);
        const double height = dot(normals_[order_[i]], point - t[0]);
        if (height * height > squared * (1 + 1e-9)) continue;
        const Vec3 q = nearest_of_triangle(t, point);
        const double d = dot(q - point, q - point);
        if (d >= squared) continue;
        squared = d;
        best.face = order_[i];
        best.point = q;
        found = true;
      }
      continue;
    }
    const double l = squared_to_box(nodes_[node.left].box, point), r = squared_to_box(nodes_[node.right].box, point);
    stack[size++] = l < r ? node.right : node.left;
    stack[size++] = l < r ? node.left : node.right;
  }
  best.distance = found ? std::sqrt(squared) : std::numeric_limits<double>::infinity();
  return best;
}

double OracleMesh::distance_to(std::uint32_t face, Vec3 point) const {
  return length(nearest_of_triangle(mesh_.triangle(face), point) - point);
}

bool OracleMesh::crossed(Vec3 from, Vec3 to) const {
  std::uint32_t stack[64];
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    if (!segment_may_meet(node.box, from, to - from)) continue;
    if (node.left != 0) {
      stack[size++] = node.left;
      stack[size++] = node.right;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      if (meets(mesh_.triangle(order_[i]), from, to)) return true;
  }
  return false;
}

bool OracleMesh::inside(Vec3 point, const NearestFace& near) const {
  if (!solid_) return false;
  // The side of a face tells if the nearest point is not on its edges.
  const Triangle t = mesh_.triangle(near.face);
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  bool within = simple_ && near.distance > 1e-9 * radius_;
  for (int i = 0; within && i < 3; ++i)
    within = dot(cross(t[(i + 1) % 3] - t[i], near.point - t[i]), n) > 1e-5 * dot(n, n);
  return within ? dot(point - near.point, n) < 0 : std::abs(winding(point)) > 0.5;
}

double OracleMesh::winding(Vec3 point) const {
  double sum = 0;
  std::uint32_t stack[64];
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    const Vec3 r = node.center - point;
    const double d = length(r);
    if (d > kFar * node.radius) {
      sum += dot(node.area, r) / (d * d * d);
    } else if (node.left != 0) {
      stack[size++] = node.left;
      stack[size++] = node.right;
    } else {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
        sum += solid_angle(mesh_.triangle(order_[i]), point);
    }
  }
  return sum / (4 * std::acos(-1.0));
}

bool is_solid(const TriangleMesh& mesh) {
  const OracleMesh surface(mesh, true, false);
  const double offset = kOffset * diagonal(surface.bounds());
  const std::size_t stride = std::max<std::size_t>(1, mesh.faces.size() / kFacesTried);
  double sum = 0;
  int count = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); f += stride) {
    const Triangle t = mesh.triangle(f);
    const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
    if (!(length(n) > 0)) continue;
    const Vec3 center = (t[0] + t[1] + t[2]) / 3, aside = offset / length(n) * n;
    sum += std::max(std::abs(surface.winding(center + aside)), std::abs(surface.winding(center - aside)));
    ++count;
  }
  return count > 0 && sum > kSolid * count;
}

}  // namespace dismantle::families
