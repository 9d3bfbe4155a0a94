// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/surface_congruence.h"

#include "dismantle/core/span.h"
#include "dismantle/geometry/congruence.h"
#include "dismantle/geometry/triangle.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

namespace dismantle {

namespace {

/// Two vertices span no smaller triangle with the centroid, relative to the square of the distance of the first.
constexpr double kMinSine = 1e-3;
/// Largest number of candidate motions, and number of vertices that are tested before all the others.
constexpr int kMaxMotions = 5000;
constexpr std::size_t kFirstLook = 24;

/// True if a motion takes each vertex to within a distance of a surface.
bool lies_on(const TriangleMesh& mesh, const RigidTransform& motion, const SurfaceTree& surface, double within) {
  std::uint32_t hint = 0;
  const auto is_on = [&](std::size_t v) {
    const MeshDistance found = surface.distance(motion * mesh.vertices[v], hint, within);
    hint = found.face;
    return found.distance <= within;
  };
  const std::size_t count = mesh.vertices.size(), stride = count / kFirstLook + 1;
  for (std::size_t v = 0; v < count; v += stride)
    if (!is_on(v)) return false;
  for (std::size_t v = 0; v < count; ++v)
    if (!is_on(v)) return false;
  return true;
}

/// The vertices whose distances from the centroid are within `play` of one.
Span<const std::uint32_t> at_distance(const ComparedSurface& surface, double distance, double play) {
  const auto below = [&](std::uint32_t v, double d) { return surface.distances()[v] < d; };
  const auto above = [&](double d, std::uint32_t v) { return d < surface.distances()[v]; };
  const auto& order = surface.order();
  const auto first = std::lower_bound(order.begin(), order.end(), distance - play, below);
  const auto last = std::upper_bound(first, order.end(), distance + play, above);
  return {order.data() + (first - order.begin()), static_cast<std::size_t>(last - first)};
}

/// Two vertices of `a` by which it is brought onto others, seen from the centroid: the farthest, and the one that spans
/// the largest triangle with it; nothing where all vertices are on one line.
std::optional<std::pair<Vec3, Vec3>> two_vertices(const ComparedSurface& a) {
  const Vec3 first = a.mesh().vertices[a.order().back()] - a.center();
  Vec3 second;
  double largest = 0;
  for (const Vec3& p : a.mesh().vertices) {
    const double size = length(cross(first, p - a.center()));
    if (size <= largest) continue;
    largest = size;
    second = p - a.center();
  }
  if (!(largest > kMinSine * length_squared(first))) return std::nullopt;
  return std::pair{first, second};
}

}  // namespace

ComparedSurface::ComparedSurface(const TriangleMesh& mesh) : mesh_(&mesh), tree_(mesh) {
  Vec3 first;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle t = mesh.triangle(f);
    const double area = length(normal_unscaled(t)) / 2;
    area_ += area;
    first += area / 3 * (t[0] + t[1] + t[2]);
  }
  if (area_ > 0) center_ = first / area_;
  for (const Vec3& p : mesh.vertices) distances_.push_back(length(p - center_));
  order_.resize(mesh.vertices.size());
  std::iota(order_.begin(), order_.end(), 0u);
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t v, std::uint32_t w) {
    return distances_[v] != distances_[w] ? distances_[v] < distances_[w] : v < w;
  });
}

std::optional<RigidTransform> surface_congruence(const ComparedSurface& a, const ComparedSurface& b, double within) {
  if (std::abs(a.area() - b.area()) > kEqualArea * std::max(a.area(), b.area())) return std::nullopt;
  if (std::abs(a.reach() - b.reach()) > within) return std::nullopt;
  const auto two = two_vertices(a);
  if (!two) return std::nullopt;
  const auto& [p, q] = *two;
  const Mat3 from = frame_of(p, q);
  const double apart = length(p - q), least = length(cross(p, q)) / 2;
  int tried = 0;
  for (const std::uint32_t v : at_distance(b, length(p), within))
    for (const std::uint32_t w : at_distance(b, length(q), within)) {
      const Vec3 other_p = b.mesh().vertices[v] - b.center(), other_q = b.mesh().vertices[w] - b.center();
      if (std::abs(length(other_p - other_q) - apart) > within || length(cross(other_p, other_q)) < least) continue;
      if (++tried > kMaxMotions) return std::nullopt;
      const Mat3 rotation = transposed(frame_of(other_p, other_q)) * from;
      const RigidTransform motion{rotation, b.center() - rotation * a.center()};
      if (lies_on(a.mesh(), motion, b.tree(), within) && lies_on(b.mesh(), inverse(motion), a.tree(), within))
        return motion;
    }
  return std::nullopt;
}

}  // namespace dismantle
