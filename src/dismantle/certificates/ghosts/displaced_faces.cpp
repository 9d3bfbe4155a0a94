// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/displaced_faces.h"

#include "dismantle/certificates/sweep/triangle_pair_sweep.h"
#include "dismantle/narrowphase/closest_points.h"
#include "dismantle/surface/ghost_surface.h"
#include "dismantle/surface/winding_number.h"

#include <algorithm>
#include <cmath>

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

/// Calls visit(face, face of the other component) for the pairs of faces whose boxes meet while the surface is shifted.
/// Returns early, false, where visit returns false.
template <class Visit>
bool for_each_near(const SolidTree& surface, const SurfaceTree& other, Vec3 from, Vec3 to, double margin,
                   const Visit& visit) {
  for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
    const Triangle t = surface.triangle(f);
    Aabb box;
    for (int i = 0; i < 3; ++i) {
      box.extend(t[i] + from);
      box.extend(t[i] + to);
    }
    const Vec3 around{margin, margin, margin};
    box = {box.lower - around, box.upper + around};
    if (!other.for_each_in_box(box, [&](std::uint32_t face) { return visit(f, face); })) return false;
  }
  return true;
}

}  // namespace

std::size_t DisplacedFaces::count_meeting(const std::vector<Vec3>& vertices, std::size_t enough) const {
  const SolidTree surface = surface_of(*own_.tree, vertices);
  const TrianglePairSweep sweep(surface, *other_.tree, {}, {}, 0, tolerance_);
  std::size_t meeting = 0;
  for_each_near(surface, other_.shape().surface(), {}, {}, kBoxMargin * tolerance_,
                [&](std::uint32_t own, std::uint32_t other) {
                  ++tests_;
                  return sweep.test(own, other, {}).free || ++meeting < enough;
                });
  return meeting;
}

bool DisplacedFaces::apart(const std::vector<Vec3>& vertices, bool may_contain) const {
  return count_meeting(vertices, 1) == 0 && !(may_contain && contained(vertices));
}

bool DisplacedFaces::free(const std::vector<Vec3>& vertices, Vec3 from, Vec3 to) const {
  const SolidTree surface = surface_of(*own_.tree, vertices);
  const TrianglePairSweep sweep(surface, *other_.tree, {from, {}}, {to, {}}, 0, tolerance_);
  return for_each_near(surface, other_.shape().surface(), from, to, kBoxMargin * tolerance_,
                       [&](std::uint32_t own, std::uint32_t other) {
                         ++tests_;
                         return sweep.test(own, other, {}).free;
                       });
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
