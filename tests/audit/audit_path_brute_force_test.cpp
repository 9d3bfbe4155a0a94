// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/audit_path.h"

#include "dismantle/math/screw.h"
#include "tests/audit/depth_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace dismantle {
namespace {

constexpr double kTolerance = 0.02;
constexpr int kTimes = 100;    // samples of a screw motion
constexpr int kDivisions = 8;  // of an edge of a triangle

/// The solid angle of a triangle at a point, as Van Oosterom and Strackee give it.
double solid_angle(const Triangle& t, Vec3 p) {
  const Vec3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
  const double la = length(a), lb = length(b), lc = length(c);
  return 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

bool inside(const TriangleMesh& solid, Vec3 p) {
  double sum = 0;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) sum += solid_angle(solid.triangle(f), p);
  return std::fabs(sum) > 2 * std::numbers::pi;
}

double distance_to_segment(Vec3 a, Vec3 b, Vec3 p) {
  const double s = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
  return length(p - (a + s * (b - a)));
}

double distance(const TriangleMesh& solid, Vec3 p) {
  double best = 1e300;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const Triangle t = solid.triangle(f);
    const Vec3 n = normalized(normal_unscaled(t));
    const Vec3 q = p - dot(n, p - t[0]) * n;
    bool within = true;
    for (int k = 0; k < 3; ++k) within = within && dot(n, cross(t[(k + 1) % 3] - t[k], q - t[k])) >= 0;
    if (within) best = std::min(best, length(p - q));
    for (int k = 0; k < 3; ++k) best = std::min(best, distance_to_segment(t[k], t[(k + 1) % 3], p));
  }
  return best;
}

/// Points on all triangles, and the largest distance of a point of the surface from one of them.
std::vector<Vec3> surface_points(const TriangleMesh& mesh, double& spacing) {
  std::vector<Vec3> points;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle t = mesh.triangle(f);
    for (int i = 0; i <= kDivisions; ++i)
      for (int j = 0; i + j <= kDivisions; ++j)
        points.push_back(t[0] + (double(i) / kDivisions) * (t[1] - t[0]) + (double(j) / kDivisions) * (t[2] - t[0]));
    for (int k = 0; k < 3; ++k) spacing = std::max(spacing, length(t[(k + 1) % 3] - t[k]) / kDivisions);
  }
  return points;
}

struct Oracle {
  double depth = 0;    // the greatest at a sample
  double between = 0;  // how much deeper it may be between samples
};

/// The greatest depth of `moving` and `fixed` over a path, from dense samples in space and time.
Oracle look(const TriangleMesh& fixed, const TriangleMesh& moving, const std::vector<Pose>& poses) {
  Oracle oracle;
  double spacing = 0, step = 0;
  const std::vector<Vec3> of_fixed = surface_points(fixed, spacing), of_moving = surface_points(moving, spacing);
  for (std::size_t k = 0; k + 1 < poses.size(); ++k) {
    RigidTransform last = transform_from_pose(poses[k]);
    for (int i = 0; i <= kTimes; ++i) {
      const RigidTransform now = transform_from_pose(pose_between(poses[k], poses[k + 1], double(i) / kTimes));
      const RigidTransform back = inverse(now);
      for (const Vec3& p : moving.vertices) step = std::max(step, length(now * p - last * p));
      last = now;
      for (const Vec3& p : of_moving)
        if (const double d = distance(fixed, now * p); d > oracle.depth && inside(fixed, now * p)) oracle.depth = d;
      for (const Vec3& p : of_fixed)
        if (const double d = distance(moving, back * p); d > oracle.depth && inside(moving, back * p)) oracle.depth = d;
    }
  }
  oracle.between = spacing + step / 2;
  return oracle;
}

/// A random octahedron; one of three kinds is inside out, one of four has a crack.
TriangleMesh random_solid(std::mt19937_64& random, Vec3 center, double size, int kind) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> stretch(0.4, 1.6);
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) {
      Vec3 p;
      p[axis] = sign * stretch(random);
      mesh.vertices.push_back(p);
    }
  mesh.faces = {{{0, 2, 4}}, {{2, 1, 4}}, {{1, 3, 4}}, {{3, 0, 4}}, {{2, 0, 5}}, {{1, 2, 5}}, {{3, 1, 5}}, {{0, 3, 5}}};
  const Quat turn = quat_about(normalized(Vec3{normal(random), normal(random), normal(random)}), 3 * normal(random));
  for (Vec3& p : mesh.vertices) p = center + size * (mat3_from_quat(turn) * p);
  if (kind % 3 == 0) mesh = depth_scenes::inside_out(mesh);
  if (kind % 4 == 0) mesh = depth_scenes::cracked(mesh, 2);
  return mesh;
}

std::vector<Pose> random_poses(std::mt19937_64& random, Vec3 way, double angle) {
  std::normal_distribution<double> normal;
  std::vector<Pose> poses = {Pose{}};
  for (int k = 0; k < 2; ++k) {
    const Vec3 axis = normalized(Vec3{normal(random), normal(random), normal(random)});
    const Pose step{way + 0.25 * length(way) * Vec3{normal(random), normal(random), normal(random)},
                    quat_about(axis, angle * normal(random))};
    poses.push_back(step * poses.back());
  }
  return poses;
}

AuditReport audit(const TriangleMesh& fixed, const TriangleMesh& moving, const std::vector<Pose>& poses,
                  const Executor& executor = {}) {
  const Assembly a = scenes::assembly({scenes::component("fixed", fixed), scenes::component("moving", moving)});
  Path path = audit_scenes::path_of(a, kTolerance);
  path.moves = {audit_scenes::move_through({"moving"}, poses)};
  return audit_path(a, path, {executor, {}});
}

/// Both directions: what is certainly deeper than allowed is found, and what certainly is not is not reported.
TEST(AuditPath, AgreesWithDenseSamplingOfTumblingSolids) {
  constexpr std::uint64_t kSeed = 71;
  std::mt19937_64 random(kSeed);
  int rejected = 0, accepted = 0;
  for (int i = 0; i < 40; ++i) {
    const TriangleMesh fixed = random_solid(random, {}, 1, i),
                       moving = random_solid(random, {2.6, 0, 0}, i % 5 == 0 ? 0.05 : 0.6, i / 2);
    const std::vector<Pose> poses = random_poses(random, {-0.9, 0, 0}, 0.3);
    const AuditReport report = audit(fixed, moving, poses);
    const Oracle oracle = look(fixed, moving, poses);
    const auto trace =
        "scene " + std::to_string(i) + " of seed " + std::to_string(kSeed) + "\n" + depth_scenes::messages(report);
    if (oracle.depth > kTolerance + report.slack + 1e-9) {
      EXPECT_EQ(report.violations.size(), 1u) << trace;
    } else if (oracle.depth + oracle.between <= kTolerance) {
      EXPECT_TRUE(report.holds()) << trace;
    }
    if (report.violations.size() > 0) {
      const double greatest = report.violations[0].greatest;
      EXPECT_LE(greatest, oracle.depth + oracle.between + 1e-9) << trace;
      EXPECT_GE(greatest, oracle.depth / 1.06 - report.slack) << trace;
    }
    rejected += report.violations.size() > 0;
    accepted += report.holds();
  }
  EXPECT_GT(rejected, 10);
  EXPECT_GT(accepted, 10);
}

/// Moves that end at the tolerance: a corner of the moving solid is slightly more or less deep than allowed.
TEST(AuditPath, DecidesCloseToTheAllowance) {
  constexpr std::uint64_t kSeed = 72;
  std::mt19937_64 random(kSeed);
  int decided = 0;
  for (int i = 0; i < 200; ++i) {
    const TriangleMesh moving = random_solid(random, {0, 0, 4}, 1, i);
    const std::vector<Pose> turn = random_poses(random, {}, 0.4);
    double lowest = 1e300, at_start = 1e300;  // the lowest may be between the two frames
    for (const Vec3& p : moving.vertices) at_start = std::min(at_start, p.z);
    for (int k = 0; k <= 20000; ++k) {
      const RigidTransform now = transform_from_pose(pose_between(turn[0], turn[1], k / 20000.0));
      for (const Vec3& p : moving.vertices) lowest = std::min(lowest, (now * p).z);
    }
    if (lowest > at_start - 0.1) continue;
    ++decided;
    for (const double share : {0.93, 1.12}) {
      const TriangleMesh block = scenes::box({-9, -9, -9}, {9, 9, lowest + share * kTolerance});
      const AuditReport report = audit(block, moving, {turn[0], turn[1]});
      EXPECT_EQ(report.holds(), share < 1) << "scene " << i << " of seed " << kSeed << "\n"
                                           << depth_scenes::messages(report);
    }
  }
  EXPECT_GT(decided, 50);
}

TEST(AuditPath, DoesNotDependOnThreads) {
  constexpr std::uint64_t kSeed = 73;
  std::mt19937_64 random(kSeed);
  std::vector<Component> components;
  for (int i = 0; i < 12; ++i)
    components.push_back(
        scenes::component("c" + std::to_string(i), random_solid(random, {1.3 * (i % 4), 1.3 * (i / 4), 0}, 1, i)));
  const Assembly a = scenes::assembly(std::move(components));
  Path path = audit_scenes::path_of(a, kTolerance);
  std::vector<Pose> poses;
  for (int k = 0; k < 50; ++k) poses.push_back({{0.05 * k, 0.02 * k, 0}, quat_about({0, 0, 1}, 0.03 * k)});
  path.moves = {audit_scenes::move_through({"c0", "c5"}, poses)};
  const AuditReport serial = audit_path(a, path);
  EXPECT_GT(serial.violations.size(), 2u);
  for (const Executor& executor : {Executor(ExecutorKind::Threads, 4), Executor(ExecutorKind::Shuffled)}) {
    const AuditReport other = audit_path(a, path, {executor, {}});
    EXPECT_EQ(other.pairs, serial.pairs);
    EXPECT_EQ(other.violations, serial.violations);
    EXPECT_EQ(other.pieces, serial.pieces);
  }
}

}  // namespace
}  // namespace dismantle
