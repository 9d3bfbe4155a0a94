// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/vec3.h"

namespace dismantle {

/// A 3x3 matrix; the identity by default.
struct Mat3 {
  Vec3 row[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< Its rows.

  /// The matrix times the column vector.
  DISMANTLE_HOST_DEVICE friend Vec3 operator*(const Mat3& m, Vec3 v) {
    return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
  }
  /// True if all entries are equal.
  DISMANTLE_HOST_DEVICE friend bool operator==(const Mat3& a, const Mat3& b) {
    return a.row[0] == b.row[0] && a.row[1] == b.row[1] && a.row[2] == b.row[2];
  }
};

/// The transposed matrix.
DISMANTLE_HOST_DEVICE inline Mat3 transposed(const Mat3& m) {
  return {{{m.row[0].x, m.row[1].x, m.row[2].x},
           {m.row[0].y, m.row[1].y, m.row[2].y},
           {m.row[0].z, m.row[1].z, m.row[2].z}}};
}

/// The matrix product.
DISMANTLE_HOST_DEVICE inline Mat3 operator*(const Mat3& a, const Mat3& b) {
  const Mat3 bt = transposed(b);
  Mat3 c;
  for (int i = 0; i < 3; ++i) c.row[i] = {dot(a.row[i], bt.row[0]), dot(a.row[i], bt.row[1]), dot(a.row[i], bt.row[2])};
  return c;
}

/// The determinant.
DISMANTLE_HOST_DEVICE inline double determinant(const Mat3& m) {
  return dot(m.row[0], cross(m.row[1], m.row[2]));
}

}  // namespace dismantle
