// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/bvh.h"
#include "dismantle/geometry/kdop.h"
#include "dismantle/geometry/triangle_mesh.h"

namespace dismantle {

/// S_v -> S_bv: the bounds of a leaf's triangle over the whole step, S_v(n) and S_v(n+1) together; linear vertex paths
/// stay within. Item: a leaf.
struct BvhRefitLeafKernel {
  Span<const Vec3> vertices_t0, vertices_t1;  ///< The same span twice where nothing moves.
  Span<const Face> faces;                     ///< In leaf order.
  Span<Kdop16> bounds;                        ///< Of all nodes.
  float margin = 0;                           ///< [mm]

  DISMANTLE_HOST_DEVICE void operator()(std::size_t leaf) const {
    const Face face = faces[leaf];
    KdopOfPoints points;
    for (int k = 0; k < 3; ++k) points.extend(vertices_t0[face.v[k]]);
    if (vertices_t1.data() != vertices_t0.data())
      for (int k = 0; k < 3; ++k) points.extend(vertices_t1[face.v[k]]);
    bounds[leaf] = points.rounded_outward(margin);
  }
};

/// S_bv -> S_bvh: the bounds around an inner node's children. Item: an inner node, counted from the first. Children
/// before parents: in ascending order, or level by level.
struct BvhRefitNodeKernel {
  BvhView tree;
  Span<Kdop16> bounds;

  DISMANTLE_HOST_DEVICE void operator()(std::size_t inner) const {
    const BvhChildren c = tree.children[inner];
    bounds[tree.leaf_count + inner] = united(bounds[c.left], bounds[c.right]);
  }
};

}  // namespace dismantle
