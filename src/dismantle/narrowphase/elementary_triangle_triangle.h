// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/elementary_edge_edge.h"
#include "dismantle/narrowphase/elementary_vertex_face.h"
#include "dismantle/narrowphase/nonpenetration_filter.h"

#include <cstdint>

namespace dismantle {

/// A moving triangle and which of its features it stands for (bits as representative_features gives them: 0-2 its
/// corners, 3-5 its edges from corner k to corner (k+1)%3). Its face is always its own.
struct ElementaryTriangle {
  TriangleMotion motion;
  std::uint8_t features = kAllFeatures;

  static constexpr std::uint8_t kAllFeatures = 0x3f;
};

/// The first contact of a triangle pair, and what it cost to find.
struct ElementaryPairResult {
  CcdResult ccd;             ///< `iterations`: roots looked at.
  int filtered = 0;          ///< Feature pairs that the non-penetration filter decided.
  int elementary_tests = 0;  ///< Feature pairs that needed the elementary test itself.
};

namespace detail {

DISMANTLE_HOST_DEVICE inline void add_test(ElementaryPairResult& total, const CcdResult& test) {
  ++total.elementary_tests;
  total.ccd.iterations += test.iterations;
  if (test.status == CcdStatus::Free) return;
  if (total.ccd.status == CcdStatus::Free || test.toi < total.ccd.toi) total.ccd.toi = test.toi;
  total.ccd.status = CcdStatus::Contact;
}

DISMANTLE_HOST_DEVICE inline void add_vertices_against_face(ElementaryPairResult& total, const ElementaryTriangle& a,
                                                            const TriangleMotion& face) {
  for (int i = 0; i < 3; ++i) {
    if (!(a.features >> i & 1)) continue;
    const VertexFaceMotion motion{a.motion.t0[i], a.motion.t1[i], face.t0, face.t1};
    const BernsteinCubic cubic = coplanarity_cubic(motion);
    if (certainly_never_coplanar(cubic)) {
      ++total.filtered;
    } else {
      add_test(total, elementary_vertex_face(motion, cubic));
    }
  }
}

DISMANTLE_HOST_DEVICE inline void add_edge_against_edges(ElementaryPairResult& total, const TriangleMotion& a, int i,
                                                         const ElementaryTriangle& b) {
  const int i_end = (i + 1) % 3;
  for (int j = 0; j < 3; ++j) {
    if (!(b.features >> (3 + j) & 1)) continue;
    const int j_end = (j + 1) % 3;
    const EdgeEdgeMotion motion{{a.t0[i], a.t0[i_end]},
                                {a.t1[i], a.t1[i_end]},
                                {b.motion.t0[j], b.motion.t0[j_end]},
                                {b.motion.t1[j], b.motion.t1[j_end]}};
    const BernsteinCubic cubic = coplanarity_cubic(motion);
    if (certainly_never_coplanar(cubic)) {
      ++total.filtered;
    } else {
      add_test(total, elementary_edge_edge(motion, cubic));
    }
  }
}

}  // namespace detail

/// The paper's continuous test of a triangle pair (Du et al. 2015, section 4.3): up to 6 vertex-face and 9 edge-edge
/// tests, only of the features that the triangles stand for, each behind the deforming non-penetration filter. Linear
/// vertex paths; touching counts; as (un)certain as the elementary tests. Triangles that intersect at the start without
/// any feature pair meeting later are *not* noticed: such pairs are the discrete test's.
DISMANTLE_HOST_DEVICE inline ElementaryPairResult elementary_triangle_triangle(const ElementaryTriangle& a,
                                                                               const ElementaryTriangle& b) {
  ElementaryPairResult total;
  detail::add_vertices_against_face(total, a, b.motion);
  detail::add_vertices_against_face(total, b, a.motion);
  for (int i = 0; i < 3; ++i)
    if (a.features >> (3 + i) & 1) detail::add_edge_against_edges(total, a.motion, i, b);
  return total;
}

}  // namespace dismantle
