// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/surface_moments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dismantle {

SurfaceMoments surface_moments(const Triangle& t) {
  const Vec3 p = t[0], q = t[1], r = t[2], sum = p + q + r;
  SurfaceMoments m;
  m.area = length(normal_unscaled(t)) + std::numeric_limits<double>::min();
  const double w = m.area / 12;
  const auto product = [&](int i, int j) { return w * (sum[i] * sum[j] + p[i] * p[j] + q[i] * q[j] + r[i] * r[j]); };
  m.first = (m.area / 3) * sum;
  m.square = {product(0, 0), product(1, 1), product(2, 2)};
  m.mixed = {product(1, 2), product(2, 0), product(0, 1)};
  return m;
}

Mat3 surface_covariance(const SurfaceMoments& m) {
  const Vec3 c = m.first / m.area;
  const auto about = [&](double moment, int i, int j) { return moment / m.area - c[i] * c[j]; };
  const double xy = about(m.mixed.z, 0, 1), xz = about(m.mixed.y, 0, 2), yz = about(m.mixed.x, 1, 2);
  return {{{about(m.square.x, 0, 0), xy, xz}, {xy, about(m.square.y, 1, 1), yz}, {xz, yz, about(m.square.z, 2, 2)}}};
}

double surface_volume(const SurfaceMoments& m, double floor) {
  Mat3 a = surface_covariance(m);
  for (int i = 0; i < 3; ++i) a.row[i][i] += floor * floor;
  return std::sqrt(std::max(0.0, dot(a.row[0], cross(a.row[1], a.row[2]))));
}

}  // namespace dismantle
