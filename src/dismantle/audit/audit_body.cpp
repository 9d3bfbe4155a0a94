// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/audit_body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace dismantle::audit {

namespace {

double squared_distance_to_segment(Vec3 a, Vec3 b, Vec3 point) {
  const Vec3 edge = b - a;
  const double squared = dot(edge, edge);
  double s = squared > 0 ? dot(point - a, edge) / squared : 0;
  s = s < 0 ? 0 : (s > 1 ? 1 : s);
  const Vec3 offset = point - (a + s * edge);
  return dot(offset, offset);
}

/// True if the plane of a triangle is at least `distance` from a point, and so is the triangle. False for slivers,
/// whose normals are not exact enough to tell.
bool plane_is_beyond(const Triangle& t, Vec3 point, double distance) {
  constexpr double kSliverSineSquared = 1e-2;
  const Vec3 e = t[1] - t[0], f = t[2] - t[0], normal = cross(e, f);
  const double squared = dot(normal, normal), height = dot(normal, point - t[0]);
  return height * height >= distance * distance * squared && squared > kSliverSineSquared * dot(e, e) * dot(f, f);
}

double squared_distance_to_box(const BoxNode& node, Vec3 point) {
  const Vec3 offset = point - node.center;
  double squared = 0;
  for (int i = 0; i < 3; ++i) {
    const double outside = std::fabs(offset[i]) - node.half[i];
    if (outside > 0) squared += outside * outside;
  }
  return squared;
}

/// Orthonormal frames whose third rows are ray directions, unlikely to be parallel to a plane of a CAD model.
const Mat3* ray_frames(int& count) {
  static const auto frames = [] {
    std::vector<Mat3> made;
    const Vec3 directions[] = {{0.5257311, 0.2763932, 0.8044721},
                               {-0.4472135, 0.7236068, 0.5257312},
                               {0.3137085, -0.8712904, 0.3774128},
                               {-0.6180340, -0.3715981, 0.6927563},
                               {0.8944272, 0.1316725, -0.4270510}};
    for (const Vec3& direction : directions) {
      const Vec3 d = normalized(direction);
      const Vec3 u = normalized(cross(d, Vec3{0.6123724, 0.3535534, -0.7071068}));
      made.push_back({{u, cross(d, u), d}});
    }
    return made;
  }();
  count = static_cast<int>(frames.size());
  return frames.data();
}

/// Boxes are enlarged by this share of the body's size, for rounding.
constexpr double kBoxMargin = 1e-9;

/// Twice the signed area of (point, a, b) in the plane perpendicular to the ray. Swapping a and b negates it exactly,
/// so that two triangles always agree about the side of their common edge on which the ray is.
double side_of_edge(Vec3 a, Vec3 b, Vec3 point) {
  return (a.x - point.x) * (b.y - point.y) - (b.x - point.x) * (a.y - point.y);
}

/// @param inverse of each coordinate of the ray's direction
bool ray_meets_box(const BoxNode& node, Vec3 point, Vec3 inverse, double margin) {
  double first = 0, last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const double half = node.half[i] + margin;
    const double near = (node.center[i] - half - point[i]) * inverse[i];
    const double far = (node.center[i] + half - point[i]) * inverse[i];
    first = std::max(first, std::min(near, far));
    last = std::min(last, std::max(near, far));
  }
  return first <= last;
}

}  // namespace

double distance_to_triangle(const Triangle& t, Vec3 point) {
  const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
  const double squared = dot(normal, normal);
  if (squared > 0) {
    bool above = true;
    for (int k = 0; k < 3 && above; ++k) above = dot(cross(normal, t[(k + 1) % 3] - t[k]), point - t[k]) >= 0;
    if (above) return std::fabs(dot(normal, point - t[0])) / std::sqrt(squared);
  }
  return std::sqrt(
      std::min({squared_distance_to_segment(t[0], t[1], point), squared_distance_to_segment(t[1], t[2], point),
                squared_distance_to_segment(t[2], t[0], point)}));
}

AuditBody::AuditBody(const Component& component)
    : mesh_(assembled_mesh(component)), closed_(component.faults.closed()) {
  const Aabb box = bounds(mesh_);
  if (box.empty()) return;
  center_ = box.center();
  coordinate_bound_ = std::max(max_abs(box.lower), max_abs(box.upper));
  for (Vec3& p : mesh_.vertices) p = p - center_;
  if (mesh_.faces.empty()) return;

  std::vector<Vec3> centroids;
  centroids.reserve(mesh_.faces.size());
  for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f) {
    const Triangle t = triangle(f);
    centroids.push_back((t[0] + t[1] + t[2]) / 3.0);
  }
  std::vector<std::uint32_t> order(mesh_.faces.size());
  std::iota(order.begin(), order.end(), 0u);
  nodes_.reserve(2 * mesh_.faces.size());
  build(0, static_cast<std::uint32_t>(order.size()), order, centroids);
  find_pieces();
}

RigidTransform AuditBody::world_from_body(const Pose& pose) const {
  const Mat3 rotation = mat3_from_quat(pose.rotation);
  return {rotation, rotation * center_ + pose.position};
}

std::uint32_t AuditBody::build(std::uint32_t first, std::uint32_t count, std::vector<std::uint32_t>& order,
                               const std::vector<Vec3>& centroids) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Aabb box, spread;
  for (std::uint32_t i = first; i < first + count; ++i) {
    for (const std::uint32_t v : mesh_.faces[order[i]].v) box.extend(mesh_.vertices[v]);
    spread.extend(centroids[order[i]]);
  }
  BoxNode node;
  node.center = box.center();
  node.half = max(box.upper - node.center, node.center - box.lower);
  node.radius = length(node.half);
  node.reach = length(node.center) + node.radius;
  node.face = order[first];
  nodes_.push_back(node);
  if (count == 1) return index;

  const Vec3 size = spread.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const std::uint32_t half = count / 2;
  const auto begin = order.begin() + first;
  std::nth_element(begin, begin + half, begin + count, [&](std::uint32_t a, std::uint32_t b) {
    const double at_a = centroids[a][axis], at_b = centroids[b][axis];
    return at_a != at_b ? at_a < at_b : a < b;
  });
  build(first, half, order, centroids);
  nodes_[index].right = build(first + half, count - half, order, centroids);
  return index;
}

void AuditBody::find_pieces() {
  std::vector<std::uint32_t> parent(mesh_.vertices.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&parent](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Face& f : mesh_.faces) {
    parent[root(f.v[1])] = root(f.v[0]);
    parent[root(f.v[2])] = root(f.v[0]);
  }
  for (std::uint32_t v = 0; v < parent.size(); ++v)
    if (root(v) == v) piece_vertices_.push_back(v);
}

SurfacePoint AuditBody::closest(Vec3 point, std::uint32_t hint) const {
  SurfacePoint best{distance_to_triangle(triangle(hint), point), hint};
  struct Open {
    std::uint32_t node = 0;
    double squared = 0;  // distance from its box
  } stack[128];
  int depth = 0;
  stack[depth++] = {0, squared_distance_to_box(nodes_[0], point)};
  while (depth > 0) {
    const Open open = stack[--depth];
    if (open.squared >= best.distance * best.distance) continue;
    const BoxNode& node = nodes_[open.node];
    if (node.leaf()) {
      const Triangle t = triangle(node.face);
      if (plane_is_beyond(t, point, best.distance)) continue;
      const double distance = distance_to_triangle(t, point);
      if (distance < best.distance) best = {distance, node.face};
      continue;
    }
    const Open left{open.node + 1, squared_distance_to_box(nodes_[open.node + 1], point)};
    const Open right{node.right, squared_distance_to_box(nodes_[node.right], point)};
    const bool left_is_nearer = left.squared <= right.squared;
    stack[depth++] = left_is_nearer ? right : left;
    stack[depth++] = left_is_nearer ? left : right;
  }
  return best;
}

template <class MayMeet, class Visit>
bool AuditBody::visit_faces(const MayMeet& may_meet, const Visit& visit) const {
  std::uint32_t stack[128];
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t i = stack[--depth];
    const BoxNode& node = nodes_[i];
    if (!may_meet(node)) continue;
    if (node.leaf()) {
      if (!visit(node.face)) return false;
      continue;
    }
    stack[depth++] = node.right;
    stack[depth++] = i + 1;
  }
  return true;
}

double AuditBody::distance_from_box(Vec3 point) const {
  return std::sqrt(squared_distance_to_box(nodes_[0], point));
}

std::optional<std::uint32_t> AuditBody::face_within(Vec3 point, double distance, std::uint32_t hint) const {
  if (distance_to_triangle(triangle(hint), point) <= distance) return hint;
  std::optional<std::uint32_t> found;
  visit_faces([&](const BoxNode& node) { return squared_distance_to_box(node, point) <= distance * distance; },
              [&](std::uint32_t face) {
                if (distance_to_triangle(triangle(face), point) <= distance) found = face;
                return !found;
              });
  return found;
}

AuditBody::Crossing AuditBody::crossing(std::uint32_t face, Vec3 point, const Mat3& frame) const {
  constexpr double kUndecided = 1e-13;
  const Vec3 origin = frame * point;
  const Triangle t = triangle(face);
  const Vec3 p[3] = {frame * t[0], frame * t[1], frame * t[2]};
  const double s[3] = {side_of_edge(p[1], p[2], origin), side_of_edge(p[2], p[0], origin),
                       side_of_edge(p[0], p[1], origin)};
  const bool positive = s[0] > 0 && s[1] > 0 && s[2] > 0, negative = s[0] < 0 && s[1] < 0 && s[2] < 0;
  const double undecided = kUndecided * nodes_[0].reach * (nodes_[0].reach + length(point));
  const bool outside_surely = (s[0] > undecided || s[1] > undecided || s[2] > undecided) &&
                              (s[0] < -undecided || s[1] < -undecided || s[2] < -undecided);
  Crossing found;
  if (outside_surely) return found;
  for (const double value : s)
    if (std::fabs(value) <= undecided) found.certain = false;
  if (!positive && !negative) return found;
  found.number = positive ? 1 : -1;
  found.height = (s[0] * p[0].z + s[1] * p[1].z + s[2] * p[2].z) / (s[0] + s[1] + s[2]) - origin.z;
  return found;
}

AuditBody::Winding AuditBody::winding(Vec3 point, const Mat3& frame) const {
  const double margin = kBoxMargin * nodes_[0].reach;
  const Vec3 direction = frame.row[2], inverse{1 / direction.x, 1 / direction.y, 1 / direction.z};
  Winding result;
  visit_faces([&](const BoxNode& node) { return ray_meets_box(node, point, inverse, margin); },
              [&](std::uint32_t face) {
                const Crossing found = crossing(face, point, frame);
                result.certain = result.certain && found.certain;
                if (found.height > 0) result.number += found.number;
                return true;
              });
  return result;
}

std::optional<int> AuditBody::crossings_between(Vec3 from, Vec3 to) const {
  const double way = length(to - from), margin = kBoxMargin * nodes_[0].reach;
  if (way == 0) return 0;
  const Vec3 direction = (1 / way) * (to - from), size = max(direction, -direction);
  const Vec3 least = size.x <= size.y && size.x <= size.z ? Vec3{1, 0, 0}
                     : size.y <= size.z                   ? Vec3{0, 1, 0}
                                                          : Vec3{0, 0, 1};
  const Vec3 across = normalized(cross(direction, least));
  const Mat3 frame{{across, cross(direction, across), direction}};
  const Vec3 center = (from + to) / 2.0, half = max(to - center, center - to) + Vec3{margin, margin, margin};
  const auto may_meet = [&](const BoxNode& node) {
    const Vec3 offset = node.center - center, apart = max(offset, -offset) - (half + node.half);
    return apart.x <= 0 && apart.y <= 0 && apart.z <= 0;
  };
  int number = 0;
  const bool certain = visit_faces(may_meet, [&](std::uint32_t face) {
    const Crossing found = crossing(face, from, frame);
    if (!found.certain) return false;
    if (found.number == 0) return true;
    if (std::fabs(found.height) <= margin || std::fabs(found.height - way) <= margin) return false;
    if (found.height > 0 && found.height < way) number += found.number;
    return true;
  });
  if (!certain) return std::nullopt;
  return number;
}

bool AuditBody::contains(Vec3 point) const {
  for (int i = 0; i < 3; ++i)
    if (std::fabs(point[i] - nodes_[0].center[i]) > nodes_[0].half[i]) return false;
  return ray_crossings(point).number != 0;
}

RayCrossings AuditBody::ray_crossings(Vec3 point, int first) const {
  int count = 0;
  const Mat3* frames = ray_frames(count);
  RayCrossings last;
  for (int k = first; k < count; ++k) {
    const Winding found = winding(point, frames[k]);
    last = {found.number, frames[k].row[2], found.certain};
    if (found.certain) break;
  }
  return last;
}

}  // namespace dismantle::audit
