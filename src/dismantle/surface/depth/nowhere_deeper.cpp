// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/depth/nowhere_deeper.h"

#include "dismantle/bvh/obb_fit.h"
#include "dismantle/math/vec3f.h"
#include "dismantle/narrowphase/closest_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace dismantle {

namespace {

constexpr int kMaxBoxes = 60000;
/// Lengths along the surface count for this share where boxes are halved.
constexpr double kAlong = 0.05;

/// A box by its middle and the vectors from there to the middles of three faces.
struct Box {
  Vec3 middle;
  std::array<Vec3, 3> half;

  double radius() const {
    double longest = 0;
    for (const Vec3& corner : corners()) longest = std::max(longest, length(corner - middle));
    return longest;
  }

  std::array<Vec3, 8> corners() const {
    std::array<Vec3, 8> result;
    for (unsigned i = 0; i < 8; ++i)
      result[i] =
          middle + (i & 1 ? 1.0 : -1.0) * half[0] + (i & 2 ? 1.0 : -1.0) * half[1] + (i & 4 ? 1.0 : -1.0) * half[2];
    return result;
  }
};

/// A box around a surface, along its principal axes: many parts are thin, and do not stand along the axes.
Box box_around(const SurfaceTree& surface) {
  std::vector<Vec3> vertices;
  std::vector<Face> faces;
  for (std::uint32_t f = 0; f < surface.face_count(); ++f) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const Vec3& corner : surface.triangle(f).corner) vertices.push_back(corner);
    faces.push_back({{first, first + 1, first + 2}});
  }
  std::vector<std::uint32_t> order(faces.size());
  std::iota(order.begin(), order.end(), 0u);
  const Vec3 origin = vertices.front();
  const Obb obb = obb_fit(vertices, faces, order, origin);
  const Vec3 half = to_double(obb.half);
  return {origin + to_double(obb.center),
          {{half.x * to_double(obb.axis[0]), half.y * to_double(obb.axis[1]), half.z * to_double(obb.third_axis())}}};
}

/// Halves a box along the axis along which the distance from the surface changes most.
/// @param across the direction of the nearest face
std::array<Box, 2> halves(const Box& box, Vec3 across) {
  const auto change = [&](int k) { return std::abs(dot(across, box.half[k])) + kAlong * length(box.half[k]); };
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (change(k) > change(axis)) axis = k;
  std::array<Box, 2> result{box, box};
  for (int side = 0; side < 2; ++side) {
    result[side].half[axis] = box.half[axis] / 2;
    result[side].middle = box.middle + (side == 0 ? -0.5 : 0.5) * box.half[axis];
  }
  return result;
}

}  // namespace

bool is_nowhere_deeper(const SolidShape& solid, double limit) {
  if (!solid.winding().closed()) return false;
  const SurfaceTree& surface = solid.surface();
  std::vector<Box> boxes{box_around(surface)};
  std::uint32_t face = 0;
  for (int count = 0; !boxes.empty(); ++count) {
    if (count == kMaxBoxes) return false;
    const Box box = boxes.back();
    boxes.pop_back();
    const double radius = box.radius();
    const MeshDistance nearest = surface.distance(box.middle, face);
    face = nearest.face;
    if (nearest.distance + radius <= limit) continue;
    const std::array<Vec3, 8> corners = box.corners();
    const auto is_near = [&](Vec3 corner) { return surface.distance_to_face(corner, face) <= limit; };
    if (std::all_of(corners.begin(), corners.end(), is_near)) continue;
    const bool inside = solid.winding().inside(box.middle);
    if (!inside && nearest.distance > radius) continue;
    if (inside && nearest.distance > limit) return false;
    const Vec3 foot = closest_point_of_triangle(surface.triangle(face), box.middle);
    for (const Box& half : halves(box, normalized(foot - box.middle))) boxes.push_back(half);
  }
  return true;
}

}  // namespace dismantle
