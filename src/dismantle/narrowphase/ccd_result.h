// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle.h"

namespace dismantle {

/// The result of a continuous test.
enum class CcdStatus {
  Free,     ///< No contact during the whole motion.
  Contact,  ///< Contact, at `toi` or later for a conservative test.
};

/// Result and cost of a continuous test.
struct CcdResult {
  CcdStatus status = CcdStatus::Free;  ///< Free or Contact.
  double toi = 1;                      ///< Fraction of the motion in [0, 1]; 1 where free.
  int iterations = 0;                  ///< Steps of the advancement, or roots tested.
};

/// A point and a triangle at the beginning (t0) and the end (t1) of linear vertex paths [mm].
struct VertexFaceMotion {
  ///@{ The point.
  Vec3 vertex_t0, vertex_t1;
  ///@}
  ///@{ The triangle.
  Triangle face_t0, face_t1;
  ///@}
};

/// Two segments at the beginning (t0) and the end (t1) of linear vertex paths [mm].
struct EdgeEdgeMotion {
  ///@{ The ends of the first segment.
  Vec3 a_t0[2], a_t1[2];
  ///@}
  ///@{ The ends of the second segment.
  Vec3 b_t0[2], b_t1[2];
  ///@}
};

/// A triangle at the beginning (t0) and the end (t1) of linear vertex paths [mm].
struct TriangleMotion {
  ///@{ Its corners.
  Triangle t0, t1;
  ///@}
};

}  // namespace dismantle
