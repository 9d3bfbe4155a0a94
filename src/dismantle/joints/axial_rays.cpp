// SPDX-License-Identifier: Apache-2.0
#include "dismantle/joints/axial_rays.h"

#include "dismantle/math/angle.h"

#include <algorithm>
#include <array>
#include <utility>

namespace dismantle {

namespace {

/// Angle of the first ray, as a share of the angle between rays: no plane of symmetry of a drawn shape.
constexpr double kFirstRay = 0.37;

/// A point across the axis [mm].
struct Across {
  double x = 0, y = 0;
};

/// The frame of the assembly's axis in that of the component's mesh.
AxisFrame in_mesh(const AxisFrame& frame, const RigidTransform& assembly_from_mesh) {
  const RigidTransform mesh_from_assembly = inverse(assembly_from_mesh);
  AxisFrame own;
  own.point = mesh_from_assembly * frame.point;
  own.direction = mesh_from_assembly.rotation * frame.direction;
  own.first = mesh_from_assembly.rotation * frame.first;
  own.second = mesh_from_assembly.rotation * frame.second;
  return own;
}

/// The unit vectors of the rays.
std::array<Across, AxialRays::kRays> ray_directions() {
  std::array<Across, AxialRays::kRays> rays;
  for (std::size_t j = 0; j < rays.size(); ++j) {
    const double angle = kTurn * (static_cast<double>(j) + kFirstRay) / static_cast<double>(rays.size());
    rays[j] = {std::cos(angle), std::sin(angle)};
  }
  return rays;
}

/// Where the plane at 0 cuts the side from `a` to `b`; the heights are those above the plane. @pre they differ in sign
Across cut(const Across& a, const Across& b, double height_a, double height_b) {
  const double t = height_a / (height_a - height_b);
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

double median(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

AxialRays::AxialRays(const Component& component, const AxisFrame& frame, Span<const double> positions)
    : begin_(positions.size() * kRays + 1) {
  const TriangleMesh& mesh = *component.mesh;
  const AxisFrame own = in_mesh(frame, component.assembly_from_mesh);
  const std::array<Across, kRays> rays = ray_directions();
  std::vector<double> heights;
  heights.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) heights.push_back(own.along(v));

  std::vector<std::pair<std::size_t, double>> found;  // slot and distance
  for (const Face& face : mesh.faces) {
    const auto [low, high] = std::minmax({heights[face.v[0]], heights[face.v[1]], heights[face.v[2]]});
    const auto first = std::upper_bound(positions.begin(), positions.end(), low);
    const auto last = std::upper_bound(first, positions.end(), high);
    if (first == last) continue;
    std::array<Across, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 across = mesh.vertices[face.v[i]] - own.point;
      corners[i] = {dot(across, own.first), dot(across, own.second)};
    }
    for (auto at = first; at != last; ++at) {
      std::array<Across, 2> ends;
      std::size_t count = 0;
      for (std::size_t i = 0; i < 3 && count < 2; ++i) {
        const std::size_t k = (i + 1) % 3;
        const double a = heights[face.v[i]] - *at, b = heights[face.v[k]] - *at;
        if ((a < 0) != (b < 0)) ends[count++] = cut(corners[i], corners[k], a, b);
      }
      if (count < 2) continue;
      const std::size_t plane = static_cast<std::size_t>(at - positions.begin());
      for (std::size_t j = 0; j < kRays; ++j) {
        const Across& u = rays[j];
        const double a = u.x * ends[0].y - u.y * ends[0].x, b = u.x * ends[1].y - u.y * ends[1].x;
        if ((a < 0) == (b < 0)) continue;
        const Across point = cut(ends[0], ends[1], a, b);
        const double distance = point.x * u.x + point.y * u.y;
        if (distance > 0) found.emplace_back(plane * kRays + j, distance);
      }
    }
  }
  std::sort(found.begin(), found.end());
  distances_.reserve(found.size());
  for (const auto& [slot, distance] : found) {
    ++begin_[slot + 1];
    distances_.push_back(distance);
  }
  for (std::size_t slot = 1; slot < begin_.size(); ++slot) begin_[slot] += begin_[slot - 1];
}

Span<const double> AxialRays::crossings(std::size_t plane, std::size_t ray) const {
  const std::size_t slot = plane * kRays + ray;
  return {distances_.data() + begin_[slot], begin_[slot + 1] - begin_[slot]};
}

double AxialRays::outer(std::size_t plane) const {
  std::vector<double> last;
  for (std::size_t j = 0; j < kRays; ++j) {
    const Span<const double> ray = crossings(plane, j);
    last.push_back(ray.empty() ? 0 : ray[ray.size() - 1]);
  }
  return median(last);
}

std::size_t AxialRays::inside_at(std::size_t plane, double distance) const {
  std::size_t count = 0;
  for (std::size_t j = 0; j < kRays; ++j) {
    const Span<const double> ray = crossings(plane, j);
    count += static_cast<std::size_t>(ray.end() - std::upper_bound(ray.begin(), ray.end(), distance)) % 2;
  }
  return count;
}

std::size_t AxialRays::surrounding(std::size_t plane, double distance, double solid) const {
  std::size_t count = 0;
  for (std::size_t j = 0; j < kRays; ++j) {
    const Span<const double> ray = crossings(plane, j);
    if (ray.empty()) continue;
    count += ray.size() % 2 == 1 ? ray[0] >= solid : ray[0] <= distance;
  }
  return count;
}

double AxialRays::hole(std::size_t plane) const {
  std::vector<double> entered;
  for (std::size_t j = 0; j < kRays; ++j) {
    const Span<const double> ray = crossings(plane, j);
    if (!ray.empty()) entered.push_back(ray.size() % 2 == 1 ? 0 : ray[0]);
  }
  return median(entered);
}

}  // namespace dismantle
