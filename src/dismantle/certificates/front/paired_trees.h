// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/certificate_kernels.h"

#include <cstdint>

namespace dismantle {

/// View of an ObbTree in the memory of the host or of a device.
struct ObbTreeView {
  const ObbNode* nodes = nullptr;        ///< As ObbTree::nodes.
  const TriangleF* triangles = nullptr;  ///< As ObbTree::triangles.
};

/// The two trees of a front: makes the queries for the kernels and decides on their results. The same code on the CPU
/// and on CUDA.
struct PairedTrees {
  ObbTreeView a;         ///< Tree of component A.
  ObbTreeView b;         ///< Tree of component B.
  bool b_moves = false;  ///< B is the moving component. Queries name the moving node first.

  /// The query for the boxes of two nodes.
  DISMANTLE_HOST_DEVICE BoxPairQuery box_query(std::uint32_t node_a, std::uint32_t node_b) const {
    const ObbNode *of_a = &a.nodes[node_a], *of_b = &b.nodes[node_b];
    return {b_moves ? of_b : of_a, b_moves ? of_a : of_b};
  }
  /// The query for the triangles of two leaves. @pre both nodes are leaves
  DISMANTLE_HOST_DEVICE TrianglePairQuery triangle_query(std::uint32_t node_a, std::uint32_t node_b) const {
    const TriangleF *face_a = &a.triangles[a.nodes[node_a].child], *face_b = &b.triangles[b.nodes[node_b].child];
    return {b_moves ? face_b : face_a, b_moves ? face_a : face_b};
  }
  /// True if both nodes are leaves.
  DISMANTLE_HOST_DEVICE bool both_leaves(std::uint32_t node_a, std::uint32_t node_b) const {
    return a.nodes[node_a].leaf() && b.nodes[node_b].leaf();
  }
  /// True if the node of A is to be split rather than that of B: the larger one is.
  DISMANTLE_HOST_DEVICE bool splits_a(std::uint32_t node_a, std::uint32_t node_b) const {
    return a.nodes[node_a].size >= b.nodes[node_b].size;
  }
};

}  // namespace dismantle
