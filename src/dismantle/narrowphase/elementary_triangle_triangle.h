// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/elementary_edge_edge.h"
#include "dismantle/narrowphase/elementary_vertex_face.h"
#include "dismantle/narrowphase/nonpenetration_filter.h"
#include "dismantle/narrowphase/separating_axis.h"

#include <cstdint>

namespace dismantle {

/// A moving triangle and the features that it represents.
struct ElementaryTriangle {
  TriangleMotion motion;  ///< Its corners.
  /// Bits as of representative_features(): 0 to 2 its corners, 3 to 5 its edges from corner k to corner (k+1)%3. It
  /// always represents its face.
  std::uint8_t features = kAllFeatures;

  static constexpr std::uint8_t kAllFeatures = 0x3f;  ///< All corners and edges.
};

/// The first contact of a triangle pair, and the cost of the test.
struct ElementaryPairResult {
  CcdResult ccd;             ///< `iterations` counts roots tested.
  int filtered = 0;          ///< Feature pairs that the non-penetration filter decided.
  int elementary_tests = 0;  ///< Feature pairs that needed the elementary test itself.
};

namespace detail {

/// Adds the result of an elementary test.
DISMANTLE_HOST_DEVICE inline void add_test(ElementaryPairResult& total, const CcdResult& test) {
  ++total.elementary_tests;
  total.ccd.iterations += test.iterations;
  if (test.status == CcdStatus::Free) return;
  if (total.ccd.status == CcdStatus::Free || test.toi < total.ccd.toi) total.ccd.toi = test.toi;
  total.ccd.status = CcdStatus::Contact;
}

/// Adds the tests of the corners that `a` represents against a face.
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

/// Adds the tests of edge `i` of `a` against the edges that `b` represents.
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
/// tests of the features that the triangles represent, each after the deforming non-penetration filter. Linear vertex
/// paths; touching counts. *Not certain*, as the elementary tests. Triangles that intersect at the start and of which
/// no feature pair meets later are *not* detected: the discrete test finds them.
DISMANTLE_HOST_DEVICE inline ElementaryPairResult elementary_triangle_triangle(const ElementaryTriangle& a,
                                                                               const ElementaryTriangle& b) {
  ElementaryPairResult total;
  detail::add_vertices_against_face(total, a, b.motion);
  detail::add_vertices_against_face(total, b, a.motion);
  for (int i = 0; i < 3; ++i)
    if (a.features >> (3 + i) & 1) detail::add_edge_against_edges(total, a.motion, i, b);
  return total;
}

/// The rounding of a distance that an elementary test measures, relative to the largest coordinate: its positions and
/// closest points are a dozen operations away from the input.
inline constexpr double kElementaryDistanceRounding = 64 * kUnitRoundoff;

/// The continuous separating axis test before the elementary ones (Tang et al. 2011, which Du et al. 2015 names among
/// its low-level culls): true only if along the normal of one of the faces at the start the triangles are, during the
/// whole motion, further apart than any elementary test accepts as touching. elementary_triangle_triangle() is
/// certainly Free then, rounding included. False proves nothing.
DISMANTLE_HOST_DEVICE inline bool elementary_apart(const TriangleMotion& a, const TriangleMotion& b) {
  const RelativeHulls<3, 3> hulls(a.t0.corner, a.t1.corner, b.t0.corner, b.t1.corner);
  const Vec3 reach = max(hulls.reach[0], hulls.reach[1]);
  const double extent = 2 * max_abs(reach);  // no two points differ by more in a coordinate
  const double start = max_abs(a.t0[0]), end = max_abs(a.t1[0]);
  const double coordinate = (start > end ? start : end) + extent;
  const double apart = 2 * kInsideTolerance * extent + kElementaryDistanceRounding * coordinate;
  const auto separates = [&](Vec3 normal) {
    AxisProjections<3, 3> along(hulls, normal, -apart);
    if (along.separates_throughout()) return true;
    along.turn();
    return along.separates_throughout();
  };
  return separates(normal_unscaled(a.t0)) || separates(normal_unscaled(b.t0));
}

}  // namespace dismantle
