// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/front/certificate_kernels.h"

#include "dismantle/math/screw.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dismantle {
namespace {

constexpr double kAllowed = 0.01;

Vec3 to_double(Vec3f v) {
  return {v.x, v.y, v.z};
}

Vec3f to_float(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

TriangleF random_triangle(std::mt19937_64& random, double size) {
  const Vec3 at = scenes::random_vector(random, 10);
  TriangleF t;
  for (Vec3f& corner : t.corner) corner = to_float(at + scenes::random_vector(random, size));
  return t;
}

LinearSweep sweep_between(const Pose& start, const Pose& end) {
  const auto rounded = [](const Pose& pose) {
    const RigidTransform t = transform_from_pose(pose);
    RigidTransformF f;
    for (int i = 0; i < 3; ++i) f.row[i] = to_float(t.rotation.row[i]);
    f.translation = to_float(t.translation);
    return f;
  };
  LinearSweep sweep;
  sweep.t0 = rounded(start);
  sweep.t1 = rounded(end);
  const Mat3 middle = mat3_from_quat(pose_between(start, end, 0.5).rotation);
  for (int i = 0; i < 3; ++i) sweep.middle[i] = to_float(middle.row[i]);
  sweep.error = static_cast<float>(48 * 0x1p-24 * 60);
  sweep.limit = -static_cast<float>(kAllowed) + sweep.error;
  return sweep;
}

/// The minimum gap along the axis at both ends, in double.
double gap_along(Vec3 w, const TriangleF& a, const TriangleF& b, const Pose& start, const Pose& end) {
  double minimum = 1e300, maximum = -1e300;
  for (int k = 0; k < 3; ++k) {
    minimum = std::min(minimum, dot(w, to_double(b.corner[k])));
    for (const Pose& pose : {start, end})
      maximum = std::max(maximum, dot(w, transform_from_pose(pose) * to_double(a.corner[k])));
  }
  return minimum - maximum;
}

TEST(TriangleKernels, GapsAreTrueWithinTheirError) {
  std::mt19937_64 random(20261122);
  std::uniform_real_distribution<double> exponent(-5, 1);
  const FrontKernels kernels = front_kernels(widest_lanes());
  std::size_t separated = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    const double size = std::pow(10, exponent(random));
    const TriangleF a = random_triangle(random, size), b = random_triangle(random, size);
    const Pose start = scenes::random_pose(random, 5, 3), end = scenes::random_pose(random, size, 0.05) * start;
    const LinearSweep sweep = sweep_between(start, end);
    const TrianglePairQuery query{&a, &b};
    NodeSeparation found;
    kernels.separate_triangles(&query, 1, sweep, &found);
    if (found.gap < sweep.limit) continue;
    ++separated;
    const Vec3 w = to_double(found.certificate.axis);
    EXPECT_NEAR(length(w), 1, 1e-6);
    EXPECT_GE(gap_along(w, a, b, start, end), found.gap - sweep.error) << "trial " << trial;
  }
  EXPECT_GT(separated, 10'000u);
}

TEST(TriangleKernels, FindEveryPairSeparatedByOneOfItsAxes) {
  std::mt19937_64 random(7);
  const FrontKernels kernels = front_kernels(widest_lanes());
  for (int trial = 0; trial < 5000; ++trial) {
    const TriangleF a = random_triangle(random, 3), b = random_triangle(random, 3);
    const Pose pose = scenes::random_pose(random, 5, 3);
    const LinearSweep sweep = sweep_between(pose, pose);
    const TrianglePairQuery query{&a, &b};
    NodeSeparation found;
    kernels.separate_triangles(&query, 1, sweep, &found);
    const Triangle t{{to_double(b.corner[0]), to_double(b.corner[1]), to_double(b.corner[2])}};
    const Vec3 normal = normalized(normal_unscaled(t));
    const double best = std::max(gap_along(normal, a, b, pose, pose), gap_along(-normal, a, b, pose, pose));
    EXPECT_GE(found.gap, best - 2 * sweep.error) << "trial " << trial;
  }
}

}  // namespace
}  // namespace dismantle
