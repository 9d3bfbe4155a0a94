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
constexpr double kFar = 3;

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

Vec3 nearest_of_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 d = b - a;
  const double dd = dot(d, d);
  return a + (dd > 0 ? std::clamp(dot(p - a, d) / dd, 0.0, 1.0) : 0.0) * d;
}

Vec3 nearest_of_triangle(const Triangle& t, Vec3 p) {
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  const double nn = dot(n, n);
  bool above = nn > 0;
  for (int i = 0; above && i < 3; ++i) above = dot(cross(t[(i + 1) % 3] - t[i], p - t[i]), n) >= 0;
  if (above) return p - (dot(p - t[0], n) / nn) * n;
  Vec3 best = nearest_of_segment(p, t[0], t[1]);
  for (int i = 1; i < 3; ++i) {
    const Vec3 q = nearest_of_segment(p, t[i], t[(i + 1) % 3]);
    if (dot(q - p, q - p) < dot(best - p, best - p)) best = q;
  }
  return best;
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

}  // namespace

OracleMesh::OracleMesh(TriangleMesh mesh, bool solid)
    : mesh_(std::move(mesh)), order_(mesh_.faces.size()), solid_(solid) {
  std::iota(order_.begin(), order_.end(), 0u);
  for (const Vec3& p : mesh_.vertices) radius_ = std::max(radius_, length(p));
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
        const Vec3 q = nearest_of_triangle(mesh_.triangle(order_[i]), point);
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

}  // namespace dismantle::families
