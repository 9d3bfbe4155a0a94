// SPDX-License-Identifier: Apache-2.0
#include "bench/baselines/obb_overlap.h"

#include <cmath>

namespace dismantle {

namespace {

// Keeps the nearly zero axes of nearly parallel edges from separating anything, and covers the rounding of float32
// axes.
constexpr double kParallelEdges = 1e-6;

struct BoxAxes {
  Vec3 axis[3];
  double half[3];
};

Vec3 widened(Vec3f v) {
  return {v.x, v.y, v.z};
}

BoxAxes axes_of(const Obb& box) {
  return {{widened(box.axis[0]), widened(box.axis[1]), widened(box.third_axis())},
          {box.half.x, box.half.y, box.half.z}};
}

}  // namespace

bool boxes_overlap(const Obb& a, const Obb& b, const RigidTransform& a_from_b) {
  const BoxAxes x = axes_of(a);
  BoxAxes y = axes_of(b);
  for (Vec3& axis : y.axis) axis = a_from_b.rotation * axis;
  const Vec3 between = a_from_b * widened(b.center) - widened(a.center);

  double r[3][3], size[3][3], t[3];
  for (int i = 0; i < 3; ++i) {
    t[i] = dot(between, x.axis[i]);
    for (int j = 0; j < 3; ++j) {
      r[i][j] = dot(x.axis[i], y.axis[j]);
      size[i][j] = std::abs(r[i][j]) + kParallelEdges;
    }
  }
  for (int i = 0; i < 3; ++i) {
    const double reach_b = y.half[0] * size[i][0] + y.half[1] * size[i][1] + y.half[2] * size[i][2];
    if (std::abs(t[i]) > x.half[i] + reach_b) return false;
    const double reach_a = x.half[0] * size[0][i] + x.half[1] * size[1][i] + x.half[2] * size[2][i];
    if (std::abs(t[0] * r[0][i] + t[1] * r[1][i] + t[2] * r[2][i]) > reach_a + y.half[i]) return false;
  }
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double reach =
          x.half[i1] * size[i2][j] + x.half[i2] * size[i1][j] + y.half[j1] * size[i][j2] + y.half[j2] * size[i][j1];
      if (std::abs(t[i2] * r[i1][j] - t[i1] * r[i2][j]) > reach) return false;
    }
  }
  return true;
}

}  // namespace dismantle
