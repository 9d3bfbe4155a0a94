// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/audit_path.h"
#include "tests/audit/audit_scenes.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

/// Meshes and paths for the tests of the audit of depths.
namespace dismantle::depth_scenes {

/// A polygon in the plane z = 0, counter-clockwise, star-shaped about its mean.
using Profile = std::vector<std::pair<double, double>>;

inline Profile circle(std::uint32_t sides, double radius) {
  Profile profile;
  for (std::uint32_t k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    profile.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return profile;
}

/// A gear of trapezoidal teeth.
inline Profile gear(std::uint32_t teeth, double root, double tip, double phase) {
  Profile profile;
  const double shares[] = {0, 0.3, 0.45, 0.85};
  for (std::uint32_t k = 0; k < teeth; ++k)
    for (int i = 0; i < 4; ++i) {
      const double angle = 2 * std::numbers::pi * (k + shares[i]) / teeth + phase, radius = i < 2 ? root : tip;
      profile.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
  return profile;
}

/// A solid between two copies of a profile.
inline TriangleMesh prism(const Profile& profile, double z0, double z1) {
  TriangleMesh mesh;
  const auto n = static_cast<std::uint32_t>(profile.size());
  Vec3 mean;
  for (const auto& [x, y] : profile) mean += Vec3{x, y, 0} / double(n);
  for (const double z : {z0, z1})
    for (const auto& [x, y] : profile) mesh.vertices.push_back({x, y, z});
  mesh.vertices.push_back(mean + Vec3{0, 0, z0});
  mesh.vertices.push_back(mean + Vec3{0, 0, z1});
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t m = (k + 1) % n;
    mesh.faces.insert(mesh.faces.end(),
                      {{{k, m, n + m}}, {{k, n + m, n + k}}, {{2 * n, m, k}}, {{2 * n + 1, n + k, n + m}}});
  }
  return mesh;
}

/// A cup: a hole from the top down to `bottom` in a cylinder from 0 to `height`.
inline TriangleMesh blind_hole(std::uint32_t n, double hole, double outer, double bottom, double height) {
  TriangleMesh mesh;
  const double rings[4][2] = {{outer, 0}, {outer, height}, {hole, height}, {hole, bottom}};
  for (const auto& ring : rings)
    for (const auto& [x, y] : circle(n, ring[0])) mesh.vertices.push_back({x, y, ring[1]});
  mesh.vertices.push_back({0, 0, 0});
  mesh.vertices.push_back({0, 0, bottom});
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t m = (k + 1) % n;
    for (const std::uint32_t a : {0u, n, 2 * n}) {
      mesh.faces.push_back({{a + k, a + m, a + n + m}});
      mesh.faces.push_back({{a + k, a + n + m, a + n + k}});
    }
    mesh.faces.push_back({{3 * n + k, 3 * n + m, 4 * n + 1}});
    mesh.faces.push_back({{4 * n, m, k}});
  }
  return mesh;
}

/// The mesh with a T-junction: the last edge of a face gets a vertex in its middle that its neighbour does not have.
inline TriangleMesh cracked(TriangleMesh mesh, std::size_t face) {
  const Face f = mesh.faces[face];
  const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back((mesh.vertices[f.v[2]] + mesh.vertices[f.v[0]]) / 2.0);
  mesh.faces[face] = {{f.v[0], f.v[1], middle}};
  mesh.faces.push_back({{middle, f.v[1], f.v[2]}});
  return mesh;
}

/// The mesh without one of its faces.
inline TriangleMesh without(TriangleMesh mesh, std::size_t face) {
  mesh.faces.erase(mesh.faces.begin() + static_cast<std::ptrdiff_t>(face));
  return mesh;
}

inline TriangleMesh inside_out(TriangleMesh mesh) {
  for (Face& f : mesh.faces) std::swap(f.v[1], f.v[2]);
  return mesh;
}

inline TriangleMesh turned(const TriangleMesh& mesh, Vec3 axis, double angle) {
  return scenes::moved(mesh, Pose{{}, quat_about(axis, angle)});
}

/// A pyramid on its tip, its edges above the diagonals x = +-y turned onto the axes.
inline TriangleMesh pyramid(double degrees, double height, double tip) {
  const double b = height * std::tan(degrees / 2 * std::numbers::pi / 180), z = tip + height;
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, tip}, {b, b, z}, {-b, b, z}, {-b, -b, z}, {b, -b, z}};
  mesh.faces = {{{0, 2, 1}}, {{0, 3, 2}}, {{0, 4, 3}}, {{0, 1, 4}}, {{1, 2, 3}}, {{1, 3, 4}}};
  return turned(mesh, {0, 0, 1}, std::numbers::pi / 4);
}

/// A knife along the diagonal x = y, its edge down.
inline TriangleMesh wedge(double degrees, double length, double height, double edge) {
  const double b = height * std::tan(degrees / 2 * std::numbers::pi / 180), z = edge + height;
  TriangleMesh mesh;
  mesh.vertices = {{-length, 0, edge}, {length, 0, edge}, {length, b, z},
                   {-length, b, z},    {length, -b, z},   {-length, -b, z}};
  mesh.faces = {{{0, 1, 2}}, {{0, 2, 3}}, {{1, 0, 5}}, {{1, 5, 4}}, {{3, 2, 4}}, {{3, 4, 5}}, {{1, 4, 2}}, {{0, 3, 5}}};
  return turned(mesh, {0, 0, 1}, std::numbers::pi / 4);
}

inline TriangleMesh cone(std::uint32_t n, double degrees, double height, double tip) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, tip}, {0, 0, tip + height}};
  for (const auto& [x, y] : circle(n, height * std::tan(degrees / 2 * std::numbers::pi / 180)))
    mesh.vertices.push_back({x, y, tip + height});
  for (std::uint32_t k = 0; k < n; ++k) {
    mesh.faces.push_back({{0, 2 + (k + 1) % n, 2 + k}});
    mesh.faces.push_back({{1, 2 + k, 2 + (k + 1) % n}});
  }
  return mesh;
}

/// A ball of n meridians and m zones.
inline TriangleMesh ball(std::uint32_t n, std::uint32_t m, double r, Vec3 at) {
  TriangleMesh mesh;
  mesh.vertices.push_back(at + Vec3{0, 0, r});
  for (std::uint32_t i = 1; i < m; ++i)
    for (const auto& [x, y] : circle(n, r * std::sin(std::numbers::pi * i / m)))
      mesh.vertices.push_back(at + Vec3{x, y, r * std::cos(std::numbers::pi * i / m)});
  mesh.vertices.push_back(at - Vec3{0, 0, r});
  const auto end = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t p = (k + 1) % n, last = 1 + (m - 2) * n;
    mesh.faces.push_back({{0, 1 + k, 1 + p}});
    mesh.faces.push_back({{end, last + p, last + k}});
    for (std::uint32_t i = 0; i + 2 < m; ++i) {
      const std::uint32_t a = 1 + i * n + k, b = 1 + i * n + p;
      mesh.faces.push_back({{a, a + n, b + n}});
      mesh.faces.push_back({{a, b + n, b}});
    }
  }
  return mesh;
}

/// A square of two triangles at height z, facing up.
inline TriangleMesh sheet(double half, double z) {
  TriangleMesh mesh;
  mesh.vertices = {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}};
  mesh.faces = {{{0, 1, 2}}, {{0, 2, 3}}};
  return mesh;
}

/// The block under the plane z = 0 that most scenes press something on.
inline TriangleMesh block() {
  return scenes::box({-20, -20, -20}, {20, 20, 0});
}

/// Audits one move of the second of two components.
inline AuditReport audit_pair(const TriangleMesh& fixed, const TriangleMesh& moving, const std::vector<Pose>& poses,
                              double tolerance = 0.01) {
  const Assembly a = scenes::assembly({scenes::component("fixed", fixed), scenes::component("moving", moving)});
  Path path = audit_scenes::path_of(a, tolerance);
  path.moves = {audit_scenes::move_through({"moving"}, poses)};
  return audit_path(a, path);
}

/// The poses of a translation along `direction`, one a distance.
inline std::vector<Pose> along(Vec3 direction, const std::vector<double>& distances) {
  std::vector<Pose> poses;
  for (const double d : distances) poses.push_back({d * direction, {}});
  return poses;
}

/// 0, step, 2 step, ... `count` steps.
inline std::vector<double> steps(double step, int count) {
  std::vector<double> distances;
  for (int k = 0; k <= count; ++k) distances.push_back(step * k);
  return distances;
}

using audit_scenes::messages;

}  // namespace dismantle::depth_scenes
