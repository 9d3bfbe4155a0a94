// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/solid_body.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dismantle::audit {

namespace {

/// Number of faces from which solidity() is computed.
constexpr std::uint32_t kSolidityFaces = 256;
/// Distance from a face at which its two sides are examined, relative to the body's size.
constexpr double kSideDistance = 1e-6;

/// Winding numbers that differ by less are the same.
constexpr double kSameWinding = 1e-9;
constexpr double kSphere = 4 * std::numbers::pi;

bool in_box(const BoxNode& box, Vec3 point) {
  const Vec3 offset = point - box.center;
  return std::fabs(offset.x) <= box.half.x && std::fabs(offset.y) <= box.half.y && std::fabs(offset.z) <= box.half.z;
}

double distance_to_edge(const OpenEdge& edge, Vec3 point) {
  const Vec3 along = edge.to - edge.from;
  const double s = std::clamp(dot(point - edge.from, along) / dot(along, along), 0.0, 1.0);
  return length(point - (edge.from + s * along));
}

}  // namespace

SolidBody::SolidBody(const Component& component) : surface_(component) {
  if (surface_.empty()) return;
  TriangleMesh mesh = assembled_mesh(component);
  for (Vec3& p : mesh.vertices) p = p - surface_.center();
  orientation_ = signed_volume(mesh) < 0 ? -1 : 1;
  open_edges_ = open_boundary(mesh);
  solid_ = open_edges_.empty() || solidity() >= kMinSolidity;
}

double SolidBody::winding(Vec3 point) const {
  if (surface_.closed()) return surface_.ray_crossings(point).number;
  // A ray may pass through a crack: that of most rays is taken.
  double found[3] = {winding_by_ray(point, 0), winding_by_ray(point, 1), 0};
  if (std::fabs(found[0] - found[1]) < kSameWinding) return found[0];
  found[2] = winding_by_ray(point, 2);
  std::sort(found, found + 3);
  return found[1];
}

double SolidBody::winding_by_ray(Vec3 point, int direction) const {
  // Strips from all open edges to infinity against the ray close the surface, and the ray does not meet them.
  const RayCrossings crossings = surface_.ray_crossings(point, direction);
  return crossings.number - strip_angles(open_edges_, -crossings.direction, point) / kSphere;
}

bool SolidBody::inside(Vec3 point, LastPoint& last) const {
  if (!solid_ || (closed() && !in_box(surface_.node(0), point))) return false;
  if (!closed()) return std::fabs(winding(point)) > 0.5;
  if (last.winding)
    if (const std::optional<int> between = surface_.crossings_between(point, last.point)) {
      const int number = *last.winding + *between;
      // The segment may pass through a crack: then a ray and it must agree.
      if (surface_.closed() || surface_.ray_crossings(point).number == number) {
        last = {point, number};
        return number != 0;
      }
    }
  if (!surface_.closed()) {
    last = {point, static_cast<int>(std::lround(winding(point)))};
    return *last.winding != 0;
  }
  const RayCrossings found = surface_.ray_crossings(point);
  last = {point, found.certain ? std::optional(found.number) : std::nullopt};
  return found.number != 0;
}

bool SolidBody::outside_throughout(Vec3 point, double radius, double gap, LastPoint& last) const {
  if (!solid_) return true;
  if (closed()) return !inside(point, last);
  double gradient = 0;
  for (const OpenEdge& edge : open_edges_) {
    const double distance = std::max(distance_to_edge(edge, point) - radius, gap);
    if (!(distance > 0)) return false;
    gradient += edge.count * length(edge.to - edge.from) / (kSphere * distance * distance);
  }
  return std::fabs(winding(point)) + radius * gradient <= 0.5;
}

double SolidBody::solidity() const {
  const std::uint32_t step = std::max(1u, surface_.face_count() / kSolidityFaces);
  double area = 0, sum = 0;
  for (std::uint32_t f = 0; f < surface_.face_count(); f += step) {
    const Triangle t = surface_.triangle(f);
    const Vec3 normal = normal_unscaled(t), center = (t[0] + t[1] + t[2]) / 3.0;
    const Vec3 off = kSideDistance * surface_.node(0).reach * normalized(normal);
    const double between = (winding(center + off) + winding(center - off)) / 2;
    sum += length(normal) * std::fabs(between);
    area += length(normal);
  }
  return area > 0 ? sum / area : 0;
}

}  // namespace dismantle::audit
