// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/bvh.h"
#include "dismantle/geometry/kdop.h"
#include "dismantle/geometry/triangle_mesh.h"

namespace dismantle {

/// Stage S_v -> S_bv: bounds a leaf's triangle over the whole step, which contains the linear paths of its vertices.
/// Item: a leaf.
struct BvhRefitLeafKernel {
  Span<const Vec3> vertices_t0;  ///< Positions at the start of the step [mm].
  Span<const Vec3> vertices_t1;  ///< Positions at its end [mm]; the same span if nothing moves.
  Span<const Face> faces;        ///< In leaf order.
  Span<Kdop16> bounds;           ///< Of all nodes.
  float margin = 0;              ///< Growth of the bounds on every side [mm].
  Span<const float> margins{};   ///< Growth of each leaf in addition; empty for none.

  /// Bounds one leaf.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t leaf) const {
    const Face face = faces[leaf];
    KdopOfPoints points;
    for (int k = 0; k < 3; ++k) points.extend(vertices_t0[face.v[k]]);
    if (vertices_t1.data() != vertices_t0.data())
      for (int k = 0; k < 3; ++k) points.extend(vertices_t1[face.v[k]]);
    bounds[leaf] = points.rounded_outward(margins.empty() ? margin : margin + margins[leaf]);
  }
};

/// Stage S_bv -> S_bvh: bounds an inner node's children. Item: an inner node, counted from the first. Children must be
/// bounded before their parents: in ascending order, or level by level.
struct BvhRefitNodeKernel {
  BvhView tree;         ///< Topology.
  Span<Kdop16> bounds;  ///< Of all nodes.

  /// Bounds one inner node.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t inner) const {
    const BvhChildren c = tree.children[inner];
    bounds[tree.leaf_count + inner] = united(bounds[c.left], bounds[c.right]);
  }
};

}  // namespace dismantle
