// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/displaced_faces.h"

#include "dismantle/certificates/sweep/triangle_pair_sweep.h"
#include "dismantle/narrowphase/closest_points.h"
#include "dismantle/surface/ghost_surface.h"
#include "dismantle/surface/winding_number.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace dismantle {

namespace {

/// Faces count as near each other if their boxes are no further apart than this share of the tolerance: the test of two
/// faces may take some for touching that are apart by rounding.
constexpr double kBoxMargin = 1e-3;
/// Number of vertices of each surface that are tested.
constexpr std::size_t kContainmentSamples = 8;

/// A surface with these vertices and the faces of a component, without a tree.
SolidTree surface_of(const SolidTree& component, const std::vector<Vec3>& vertices) {
  SolidTree surface;
  surface.vertices = vertices;
  surface.faces = component.faces;
  return surface;
}

/// Calls visit(face, face of the other component) for the faces of the other component whose boxes meet that of a face
/// of the surface while this is shifted. Returns early, false, where visit returns false.
template <class Visit>
bool for_each_near(const SolidTree& surface, std::uint32_t face, const SurfaceTree& other, Vec3 from, Vec3 to,
                   double margin, const Visit& visit) {
  const Triangle t = surface.triangle(face);
  const Vec3 corners[] = {t[0] + from, t[1] + from, t[2] + from, t[0] + to, t[1] + to, t[2] + to};
  return other.for_each_near({corners, 6}, margin, [&](std::uint32_t other_face) { return visit(face, other_face); });
}

}  // namespace

DisplacedFaces::Meeting DisplacedFaces::meeting(std::vector<Vec3> vertices) const {
  const Meeting none{own_.tree->vertices, std::vector<std::uint32_t>(own_.tree->faces.size()), 0};
  return *count(none, std::move(vertices), std::numeric_limits<std::size_t>::max(), true);
}

std::optional<DisplacedFaces::Meeting> DisplacedFaces::meeting_less(const Meeting& before, std::vector<Vec3> vertices,
                                                                    std::size_t limit) const {
  return count(before, std::move(vertices), limit, false);
}

std::optional<DisplacedFaces::Meeting> DisplacedFaces::count(const Meeting& before, std::vector<Vec3> vertices,
                                                             std::size_t limit, bool all_faces) const {
  const Span<const Face> faces = own_.tree->faces;
  Meeting now{std::move(vertices), before.of_face, before.total};
  std::vector<std::uint32_t> changed;
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const auto moved = [&](std::uint32_t v) { return !(now.vertices[v] == before.vertices[v]); };
    if (!all_faces && std::none_of(std::begin(faces[f].v), std::end(faces[f].v), moved)) continue;
    changed.push_back(f);
    now.total -= now.of_face[f];
    now.of_face[f] = 0;
  }
  const SolidTree surface = surface_of(*own_.tree, now.vertices);
  const TrianglePairSweep still(surface, *other_.tree, {}, {}, 0, tolerance_);
  const auto count_pair = [&](std::uint32_t own, std::uint32_t other) {
    ++tests_;
    if (still.test(own, other, {}).free) return true;
    ++now.of_face[own];
    return ++now.total < limit;
  };
  if (now.total >= limit) return std::nullopt;
  for (const std::uint32_t f : changed)
    if (!for_each_near(surface, f, other_.shape().surface(), {}, {}, kBoxMargin * tolerance_, count_pair))
      return std::nullopt;
  return now;
}

bool DisplacedFaces::apart(const std::vector<Vec3>& vertices, bool may_contain) const {
  return free(vertices, {}, {}) && !(may_contain && contained(vertices));
}

bool DisplacedFaces::free(const std::vector<Vec3>& vertices, Vec3 from, Vec3 to) const {
  const SolidTree surface = surface_of(*own_.tree, vertices);
  const TrianglePairSweep sweep(surface, *other_.tree, {from, {}}, {to, {}}, 0, tolerance_);
  const auto is_free = [&](std::uint32_t own, std::uint32_t other) { return sweep.test(own, other, {}).free; };
  for (std::uint32_t f = 0; f < surface.faces.size(); ++f)
    if (!for_each_near(surface, f, other_.shape().surface(), from, to, kBoxMargin * tolerance_, is_free)) return false;
  return true;
}

std::vector<Vec3> DisplacedFaces::moved_out(std::vector<Vec3> vertices, double gap, double max_length) const {
  const SurfaceTree& surface = other_.shape().surface();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    Vec3& p = vertices[v];
    const MeshDistance nearest = surface.distance(p, 0, max_length);
    if (nearest.distance > max_length || nearest.distance == 0 || !other_.shape().winding().inside(p)) continue;
    const Vec3 out = (closest_point_of_triangle(surface.triangle(nearest.face), p) - p) / nearest.distance;
    const Vec3 moved = p + (nearest.distance + gap) * out - own_.tree->vertices[v];
    p = own_.tree->vertices[v] + std::min(1.0, max_length / length(moved)) * moved;
  }
  return vertices;
}

bool DisplacedFaces::contained(const std::vector<Vec3>& vertices) const {
  const auto some = [](const std::vector<Vec3>& points, const auto& inside) {
    const std::size_t stride = std::max<std::size_t>(1, points.size() / kContainmentSamples);
    for (std::size_t i = 0; i < points.size(); i += stride)
      if (inside(points[i])) return true;
    return false;
  };
  const SolidTree surface = surface_of(*own_.tree, vertices);
  const auto inside_surface = [&](Vec3 p) {
    double winding = 0;
    for (std::uint32_t f = 0; f < surface.faces.size(); ++f) winding += winding_of(surface.triangle(f), p);
    return std::abs(winding) > 0.5;
  };
  return some(vertices, [&](Vec3 p) { return other_.shape().winding().inside(p); }) ||
         some(other_.tree->vertices, inside_surface);
}

}  // namespace dismantle
