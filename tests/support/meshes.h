// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"

#include <cmath>
#include <memory>
#include <string>
#include <vector>

/// Meshes and small assemblies that tests and benchmarks share.
namespace dismantle::scenes {

/// An axis-aligned box of 12 triangles, normals out.
inline TriangleMesh box(Vec3 lower, Vec3 upper) {
  TriangleMesh m;
  for (int i = 0; i < 8; ++i)
    m.vertices.push_back({i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z});
  m.faces = {{{0, 2, 1}}, {{1, 2, 3}}, {{4, 5, 6}}, {{5, 7, 6}}, {{0, 1, 4}}, {{1, 5, 4}},
             {{2, 6, 3}}, {{3, 6, 7}}, {{0, 4, 2}}, {{2, 4, 6}}, {{1, 3, 5}}, {{3, 7, 5}}};
  return m;
}

/// A closed tube along z: outer radius, inner radius (0 makes a solid cylinder), from z0 to z1, `sides` around, `rings`
/// along.
inline TriangleMesh tube(double outer, double inner, double z0, double z1, std::uint32_t sides,
                         std::uint32_t rings = 1) {
  TriangleMesh m;
  const double turn = 2 * std::acos(-1.0) / sides;
  const auto quad = [&m](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    m.faces.push_back({{a, b, c}});
    m.faces.push_back({{a, c, d}});
  };
  const auto wall = [&](double radius) {
    const auto first = static_cast<std::uint32_t>(m.vertices.size());
    for (std::uint32_t k = 0; k <= rings; ++k)
      for (std::uint32_t i = 0; i < sides; ++i)
        m.vertices.push_back({radius * std::cos(i * turn), radius * std::sin(i * turn), z0 + (z1 - z0) * k / rings});
    return first;
  };
  const std::uint32_t out = wall(outer);
  const std::uint32_t top = rings * sides;
  const std::uint32_t in = inner > 0 ? wall(inner) : 0;
  std::uint32_t low = 0, high = 0;
  if (inner <= 0) {
    low = static_cast<std::uint32_t>(m.vertices.size());
    m.vertices.push_back({0, 0, z0});
    high = low + 1;
    m.vertices.push_back({0, 0, z1});
  }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t j = (i + 1) % sides;
    for (std::uint32_t k = 0; k < rings; ++k) {
      const std::uint32_t lower = k * sides, upper = lower + sides;
      quad(out + lower + i, out + lower + j, out + upper + j, out + upper + i);
      if (inner > 0) quad(in + lower + j, in + lower + i, in + upper + i, in + upper + j);
    }
    if (inner > 0) {
      quad(out + top + i, out + top + j, in + top + j, in + top + i);
      quad(out + j, out + i, in + i, in + j);
    } else {
      m.faces.push_back({{out + top + i, out + top + j, high}});
      m.faces.push_back({{out + j, out + i, low}});
    }
  }
  return m;
}

inline TriangleMesh moved(TriangleMesh mesh, const Pose& pose) {
  const RigidTransform t = transform_from_pose(pose);
  for (Vec3& p : mesh.vertices) p = t * p;
  return mesh;
}

/// A component with its mesh in assembly coordinates.
inline Component component(std::string name, TriangleMesh mesh) {
  Component c;
  c.name = std::move(name);
  CleanedMesh cleaned = clean_mesh(mesh);
  c.mesh = std::make_shared<const TriangleMesh>(std::move(cleaned.mesh));
  c.faults = cleaned.faults;
  return c;
}

/// An assembly of components under one root.
inline Assembly assembly(std::vector<Component> components) {
  Assembly a;
  a.source_file = "scene";
  a.tree.push_back({"scene", 0});
  for (Component& c : components) {
    c.tree_node = static_cast<std::uint32_t>(a.tree.size());
    a.tree.push_back({c.name, 0});
  }
  a.components = std::move(components);
  return a;
}

}  // namespace dismantle::scenes
