// SPDX-License-Identifier: Apache-2.0
// One kernel for each shared body. The test is that they compile as device code.
#include "dismantle/geometry/kdop.h"
#include "dismantle/narrowphase/ccd_edge_edge.h"
#include "dismantle/narrowphase/ccd_triangle_triangle.h"
#include "dismantle/narrowphase/ccd_vertex_face.h"
#include "dismantle/narrowphase/distance_triangle_triangle.h"
#include "dismantle/narrowphase/elementary_triangle_triangle.h"
#include "dismantle/narrowphase/intersect_triangle_triangle.h"
#include "dismantle/narrowphase/penetration_triangle_triangle.h"

namespace dismantle {

__global__ void intersect(const Triangle* a, const Triangle* b, bool* result) {
  *result = intersect_triangle_triangle(*a, *b);
}

__global__ void penetrate(const Triangle* a, const Triangle* b, Penetration* result) {
  *result = penetration_triangle_triangle(*a, *b);
}

__global__ void measure(const Triangle* a, const Triangle* b, TriangleDistance* result) {
  *result = distance_triangle_triangle(*a, *b);
}

__global__ void certified_pair(const TriangleMotion* a, const TriangleMotion* b, double allowed, CcdResult* result) {
  *result = ccd_triangle_triangle(*a, *b, allowed);
}

__global__ void certified_features(const VertexFaceMotion* vf, const EdgeEdgeMotion* ee, CcdResult* result) {
  result[0] = ccd_vertex_face(*vf);
  result[1] = ccd_edge_edge(*ee);
}

__global__ void elementary_pair(const ElementaryTriangle* a, const ElementaryTriangle* b,
                                ElementaryPairResult* result) {
  *result = elementary_triangle_triangle(*a, *b);
}

__global__ void bound(const Triangle* t, Kdop16* result) {
  KdopOfPoints points;
  for (int k = 0; k < 3; ++k) points.extend((*t)[k]);
  *result = points.rounded_outward(0);
}

}  // namespace dismantle
