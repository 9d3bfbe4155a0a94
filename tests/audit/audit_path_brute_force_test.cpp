// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/audit_path.h"

#include "dismantle/math/screw.h"
#include "tests/audit/audit_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace dismantle {
namespace {

constexpr double kTolerance = 0.02;
constexpr int kSamples = 400;

TriangleMesh tetrahedron(std::mt19937_64& random, Vec3 center, double size) {
  std::normal_distribution<double> normal;
  TriangleMesh mesh;
  for (int i = 0; i < 4; ++i)
    mesh.vertices.push_back(center + size * Vec3{normal(random), normal(random), normal(random)});
  const auto& v = mesh.vertices;
  if (dot(v[3] - v[0], cross(v[1] - v[0], v[2] - v[0])) > 0) std::swap(mesh.vertices[0], mesh.vertices[1]);
  mesh.faces = {{{0, 1, 2}}, {{0, 3, 1}}, {{1, 3, 2}}, {{2, 3, 0}}};
  return mesh;
}

/// The depth of two triangles, by its definition: the minimum overlap over the facet normals of the Minkowski
/// difference. The triangles are random: no edges are parallel.
double depth_by_definition(const Triangle& a, const Triangle& b) {
  std::vector<Vec3> axes = {normal_unscaled(a), normal_unscaled(b)};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) axes.push_back(cross(a[(i + 1) % 3] - a[i], b[(j + 1) % 3] - b[j]));
  double depth = 1e300;
  for (const Vec3& axis : axes) {
    const Vec3 w = normalized(axis);
    const auto [low_a, high_a] = std::minmax({dot(w, a[0]), dot(w, a[1]), dot(w, a[2])});
    const auto [low_b, high_b] = std::minmax({dot(w, b[0]), dot(w, b[1]), dot(w, b[2])});
    depth = std::min({depth, high_a - low_b, high_b - low_a});
  }
  return std::max(depth, 0.0);
}

double deepest_triangles(const TriangleMesh& a, const TriangleMesh& b) {
  double deepest = 0;
  for (std::size_t f = 0; f < a.faces.size(); ++f)
    for (std::size_t g = 0; g < b.faces.size(); ++g)
      deepest = std::max(deepest, depth_by_definition(a.triangle(f), b.triangle(g)));
  return deepest;
}

/// The depth of the deepest vertex of `points` inside the tetrahedron: its distance to the nearest face plane.
double deepest_vertex(const TriangleMesh& points, const TriangleMesh& solid) {
  double deepest = 0;
  for (const Vec3& p : points.vertices) {
    double inside = 1e300;
    for (std::size_t f = 0; f < solid.faces.size(); ++f) {
      const Triangle t = solid.triangle(f);
      inside = std::min(inside, dot(normalized(normal_unscaled(t)), t[0] - p));
    }
    deepest = std::max(deepest, inside);
  }
  return deepest;
}

struct Deepest {
  double triangles = 0, vertices = 0;
  double between = 0;  // that it may have been deeper between two samples
};

Deepest look_densely(const TriangleMesh& fixed, const TriangleMesh& moving, const std::vector<Pose>& poses) {
  Deepest deepest;
  for (std::size_t k = 0; k + 1 < poses.size(); ++k) {
    TriangleMesh last;
    for (int i = 0; i <= kSamples; ++i) {
      TriangleMesh now = scenes::moved(moving, pose_between(poses[k], poses[k + 1], double(i) / kSamples));
      deepest.triangles = std::max(deepest.triangles, deepest_triangles(fixed, now));
      deepest.vertices = std::max({deepest.vertices, deepest_vertex(now, fixed), deepest_vertex(fixed, now)});
      for (std::size_t v = 0; v < last.vertices.size(); ++v)
        deepest.between = std::max(deepest.between, 0.51 * length(now.vertices[v] - last.vertices[v]));
      last = std::move(now);
    }
  }
  return deepest;
}

std::vector<Pose> random_poses(std::mt19937_64& random, double distance, double angle) {
  std::normal_distribution<double> normal;
  std::vector<Pose> poses = {Pose{}};
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = normalized(Vec3{normal(random), normal(random), normal(random)});
    const Pose step{distance * Vec3{normal(random), normal(random), normal(random)},
                    quat_about(axis, angle * normal(random))};
    poses.push_back(step * poses.back());
  }
  return poses;
}

/// Both directions: what is certainly deeper than allowed is found, and what is certainly not is not reported.
TEST(AuditPath, AgreesWithDenseSamplingOnRandomScenes) {
  constexpr std::uint64_t kSeed = 31;
  std::mt19937_64 random(kSeed);
  int found_triangles = 0, found_vertices = 0, clean = 0;
  for (int i = 0; i < 400; ++i) {
    const TriangleMesh fixed = tetrahedron(random, {}, 1);
    const TriangleMesh moving = tetrahedron(random, {2, 0, 0}, i % 3 == 0 ? 0.01 : 0.5);
    const Assembly a = scenes::assembly({scenes::component("fixed", fixed), scenes::component("moving", moving)});
    const bool fixed_moves = i % 2 == 1;
    const std::vector<Pose> poses = random_poses(random, 1, 0.5);
    Path path = audit_scenes::path_of(a, kTolerance);
    path.moves = {audit_scenes::move_through({fixed_moves ? "fixed" : "moving"}, poses)};
    const AuditReport report = audit_path(a, path);

    const Deepest deepest = fixed_moves ? look_densely(moving, fixed, poses) : look_densely(fixed, moving, poses);
    const double missable = report.resolution / 2 + 1e-9;
    const std::size_t triangles = audit_scenes::count(report, AuditViolationKind::TrianglesIntersect);
    const std::size_t vertices = audit_scenes::count(report, AuditViolationKind::VertexInside);
    const auto trace = "scene " + std::to_string(i) + " of seed " + std::to_string(kSeed) + "\n";
    if (deepest.triangles > kTolerance + missable) {
      EXPECT_GT(triangles, 0u) << trace;
    } else if (deepest.triangles + deepest.between <= kTolerance) {
      EXPECT_EQ(triangles, 0u) << trace << audit_scenes::messages(report);
    }
    if (deepest.vertices > 2 * kTolerance + missable) {
      EXPECT_FALSE(report.holds()) << trace;  // or rule 1 was violated before
    } else if (deepest.vertices + deepest.between <= 2 * kTolerance) {
      EXPECT_EQ(vertices, 0u) << trace << audit_scenes::messages(report);
    }
    found_triangles += triangles > 0;
    found_vertices += vertices > 0;
    clean += report.holds();
  }
  EXPECT_GT(found_triangles, 50);
  EXPECT_GT(found_vertices, 20);
  EXPECT_GT(clean, 50);
}

/// Moves that end at the tolerance: the depth at the last pose is slightly more or less than allowed.
TEST(AuditPath, DecidesCorrectlyCloseToTheTolerance) {
  constexpr std::uint64_t kSeed = 32;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> excess(0.06, 0.5);
  int decided = 0;
  for (int i = 0; i < 300; ++i) {
    const TriangleMesh fixed = tetrahedron(random, {}, 1);
    const TriangleMesh moving = tetrahedron(random, {8, 0, 0}, 1);
    const std::vector<Pose> turn = random_poses(random, 0.2, 0.6);
    const auto poses_to = [&](double x) { return std::vector<Pose>{Pose{}, Pose{{x, 0, 0}, {}} * turn[1]}; };
    const double target = kTolerance * (1 + (i % 2 == 0 ? 1 : -1) * excess(random));
    double apart = 0, into = -8;  // bisect for the end of the motion that is as deep as the target
    for (int k = 0; k < 30; ++k) {
      const double middle = (apart + into) / 2;
      const TriangleMesh end = scenes::moved(moving, poses_to(middle).back());
      (deepest_triangles(fixed, end) > target ? into : apart) = middle;
    }
    const Deepest deepest = look_densely(fixed, moving, poses_to(apart));
    const Assembly a = scenes::assembly({scenes::component("fixed", fixed), scenes::component("moving", moving)});
    Path path = audit_scenes::path_of(a, kTolerance);
    path.moves = {audit_scenes::move_through({"moving"}, poses_to(apart))};
    const AuditReport report = audit_path(a, path);
    const std::size_t triangles = audit_scenes::count(report, AuditViolationKind::TrianglesIntersect);
    if (deepest.triangles > 1.051 * kTolerance) {
      EXPECT_GT(triangles, 0u) << "scene " << i << " of seed " << kSeed;
      ++decided;
    } else if (deepest.triangles + deepest.between < kTolerance) {
      EXPECT_EQ(triangles, 0u) << "scene " << i << " of seed " << kSeed << "\n" << audit_scenes::messages(report);
      ++decided;
    }
  }
  EXPECT_GT(decided, 150);
}

}  // namespace
}  // namespace dismantle
