// SPDX-License-Identifier: Apache-2.0
#include "dismantle/features/thread_fit.h"

#include "tests/support/large_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

std::vector<SurfaceSample> samples_of(const TriangleMesh& mesh) {
  return smooth_samples(mesh, std::vector<std::uint8_t>(mesh.faces.size(), 1));
}

/// A bolt of 1.25 mm pitch, right-handed or mirrored.
TriangleMesh bolt(bool left_handed) {
  TriangleMesh mesh = *scenes::bolt_in_nut(20000, 0.05).assembly.components[1].mesh;
  if (left_handed) {
    for (Vec3& p : mesh.vertices) p.x = -p.x;
    for (Face& f : mesh.faces) std::swap(f.v[1], f.v[2]);
  }
  return mesh;
}

TEST(ThreadFit, FindsAxisPitchAndHandednessInAnyOrientation) {
  std::mt19937_64 random(5);
  for (const bool left_handed : {false, true})
    for (int round = 0; round < 5; ++round) {
      const Pose pose = scenes::random_pose(random, 100, 3);
      const auto thread = fit_thread(samples_of(scenes::moved(bolt(left_handed), pose)));
      ASSERT_TRUE(thread);
      const Vec3 axis = mat3_from_quat(pose.rotation) * Vec3{0, 0, 1};
      EXPECT_NEAR(std::abs(dot(thread->direction, axis)), 1, 1e-5);
      EXPECT_NEAR(length(cross(axis, thread->point - pose.position)), 0, 0.01);
      EXPECT_NEAR(thread->lead, left_handed ? -1.25 : 1.25, 0.02);
    }
}

TEST(ThreadFit, FindsTheThreadBesideSeatsAndCollars) {
  std::vector<SurfaceSample> samples = samples_of(bolt(false));
  for (const SurfaceSample& s : samples_of(scenes::tube(4.5, 3, 22, 23, 64))) samples.push_back(s);
  const auto thread = fit_thread(samples);
  ASSERT_TRUE(thread);
  EXPECT_NEAR(thread->lead, 1.25, 0.02);
}

TEST(ThreadFit, FindsNoneOnSurfacesOfRevolutionOrExtrusion) {
  EXPECT_FALSE(fit_thread(samples_of(scenes::tube(12, 10, 0, 30, 48, 4))));
  EXPECT_FALSE(fit_thread(samples_of(scenes::revolved({{0, 0}, {5, 0}, {4, 3}, {6, 6}, {4, 9}, {0, 9}}, 64))));
  EXPECT_FALSE(fit_thread(samples_of(scenes::box({0, 0, 0}, {10, 20, 30}))));
  EXPECT_FALSE(fit_thread({}));
}

}  // namespace
}  // namespace dismantle
