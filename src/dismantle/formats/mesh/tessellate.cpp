// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/mesh/tessellate.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace dismantle {

namespace {

constexpr std::uint32_t kSides = 64;  // around; a chord is 0.0012 radii off its arc
constexpr std::uint32_t kRings = kSides / 2;

/// The point at `radius` and `height` in the direction of side `i`.
Vec3 around(double radius, double height, std::uint32_t i) {
  const double angle = 2 * std::numbers::pi * i / kSides;
  return {radius * std::cos(angle), radius * std::sin(angle), height};
}

/// A body of revolution: bottom pole, rings of kSides vertices from the bottom up, top pole.
TriangleMesh close_rings(std::vector<Vec3> rings, double bottom, double top) {
  TriangleMesh mesh;
  mesh.vertices = std::move(rings);
  const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back({0, 0, bottom});
  mesh.vertices.push_back({0, 0, top});
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const std::uint32_t j = (i + 1) % kSides, last = count - kSides;
    mesh.faces.push_back({{j, i, count}});
    for (std::uint32_t low = 0; low < last; low += kSides) {
      mesh.faces.push_back({{low + i, low + j, low + kSides + j}});
      mesh.faces.push_back({{low + i, low + kSides + j, low + kSides + i}});
    }
    mesh.faces.push_back({{last + i, last + j, count + 1}});
  }
  return mesh;
}

}  // namespace

TessellatedShape tessellate_box(Vec3 size) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(
        {(i & 1 ? 0.5 : -0.5) * size.x, (i & 2 ? 0.5 : -0.5) * size.y, (i & 4 ? 0.5 : -0.5) * size.z});
  mesh.faces = {{{0, 2, 1}}, {{1, 2, 3}}, {{4, 5, 6}}, {{5, 7, 6}}, {{0, 1, 4}}, {{1, 5, 4}},
                {{2, 6, 3}}, {{3, 6, 7}}, {{0, 4, 2}}, {{2, 4, 6}}, {{1, 3, 5}}, {{3, 7, 5}}};
  return {std::move(mesh), 0};
}

TessellatedShape tessellate_cylinder(double radius, double length) {
  std::vector<Vec3> rings;
  for (const double height : {-length / 2, length / 2})
    for (std::uint32_t i = 0; i < kSides; ++i) rings.push_back(around(radius, height, i));
  const double deflection = radius * (1 - std::cos(std::numbers::pi / kSides));
  return {close_rings(std::move(rings), -length / 2, length / 2), deflection};
}

TessellatedShape tessellate_cone(double radius, double length) {
  std::vector<Vec3> ring;
  for (std::uint32_t i = 0; i < kSides; ++i) ring.push_back(around(radius, -length / 2, i));
  const double deflection = radius * (1 - std::cos(std::numbers::pi / kSides));
  return {close_rings(std::move(ring), -length / 2, length / 2), deflection};
}

TessellatedShape tessellate_sphere(double radius) {
  std::vector<Vec3> rings;
  for (std::uint32_t ring = 1; ring < kRings; ++ring) {
    const double latitude = std::numbers::pi * (static_cast<double>(ring) / kRings - 0.5);
    for (std::uint32_t i = 0; i < kSides; ++i)
      rings.push_back(around(radius * std::cos(latitude), radius * std::sin(latitude), i));
  }
  // The deviation at the middle of a patch is the sum of the sagittas of its two arcs.
  const double deflection = 2 * radius * (1 - std::cos(std::numbers::pi / kSides));
  return {close_rings(std::move(rings), -radius, radius), deflection};
}

}  // namespace dismantle
