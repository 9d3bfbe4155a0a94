// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"

#include <algorithm>
#include <cstdint>
#include <utility>

/// Meshes with the faults that files have.
namespace dismantle::scenes {

/// The mesh with its normals turned round.
inline TriangleMesh inside_out(TriangleMesh mesh) {
  for (Face& f : mesh.faces) std::swap(f.v[1], f.v[2]);
  return mesh;
}

/// The mesh without one of its faces.
inline TriangleMesh without_face(TriangleMesh mesh, std::size_t face) {
  mesh.faces.erase(mesh.faces.begin() + static_cast<std::ptrdiff_t>(face));
  return mesh;
}

/// The mesh with a vertex in the middle of the last edge of a face, which the neighbouring face does not have.
inline TriangleMesh with_t_junction(TriangleMesh mesh, std::size_t face) {
  const Face f = mesh.faces[face];
  const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(0.5 * (mesh.vertices[f.v[2]] + mesh.vertices[f.v[0]]));
  mesh.faces[face] = {{f.v[0], f.v[1], middle}};
  mesh.faces.push_back({{middle, f.v[1], f.v[2]}});
  return mesh;
}

/// The mesh with vertices of its own for every face, each face shrunk a little towards its centroid.
inline TriangleMesh torn_apart(const TriangleMesh& mesh, double gap = 1e-3) {
  TriangleMesh torn;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle t = mesh.triangle(f);
    const Vec3 middle = (t[0] + t[1] + t[2]) / 3.0;
    const auto first = static_cast<std::uint32_t>(torn.vertices.size());
    for (int k = 0; k < 3; ++k) torn.vertices.push_back(t[k] + gap * (middle - t[k]));
    torn.faces.push_back({{first, first + 1, first + 2}});
  }
  return torn;
}

/// Both meshes as one.
inline TriangleMesh joined(TriangleMesh a, const TriangleMesh& b) {
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Face& f : b.faces) a.faces.push_back({{f.v[0] + first, f.v[1] + first, f.v[2] + first}});
  return a;
}

/// A square of two triangles at the height z, normal up.
inline TriangleMesh sheet(double half, double z) {
  return {{{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}}, {{{0, 1, 2}}, {{0, 2, 3}}}};
}

}  // namespace dismantle::scenes
