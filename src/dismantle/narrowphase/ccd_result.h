// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle.h"

namespace dismantle {

enum class CcdStatus {
  Free,     ///< No contact during the whole motion.
  Contact,  ///< Contact, at `toi` or later for a conservative test.
};

/// How a continuous test ended, and what it cost.
struct CcdResult {
  CcdStatus status = CcdStatus::Free;
  double toi = 1;      ///< Fraction of the motion in [0, 1]; 1 where free.
  int iterations = 0;  ///< Steps of the advancement, or roots looked at.
};

/// A point and a triangle at both ends of linear vertex paths [mm].
struct VertexFaceMotion {
  Vec3 vertex_t0, vertex_t1;
  Triangle face_t0, face_t1;
};

/// Two segments a0-a1 and b0-b1 at both ends of linear vertex paths [mm].
struct EdgeEdgeMotion {
  Vec3 a_t0[2], a_t1[2];
  Vec3 b_t0[2], b_t1[2];
};

/// A triangle at both ends of linear vertex paths [mm].
struct TriangleMotion {
  Triangle t0, t1;
};

}  // namespace dismantle
