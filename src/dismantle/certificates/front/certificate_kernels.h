// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/obb_tree.h"
#include "dismantle/certificates/front/linear_sweep.h"
#include "dismantle/math/lane_dispatch.h"

#include <cstddef>

namespace dismantle {

/// Certificates for lanes: blocks of kBlock, each field of a block in a row. What one certificate touches lies
/// together, and what lanes load does.
struct CertificateBlocks {
  static constexpr std::size_t kBlock = 16;
  /// Axis, offset, the hull's center, its three spans, its kind.
  static constexpr std::size_t kFields = 17;
  const float* data = nullptr;

  /// Where field `k` of certificate `i` is.
  DISMANTLE_HOST_DEVICE static constexpr std::size_t place(std::size_t i, std::size_t k) {
    return (i / kBlock * kFields + k) * kBlock + i % kBlock;
  }

  DISMANTLE_HOST_DEVICE Vec3f vector(std::size_t i, std::size_t k) const {
    const float* from = data + place(i, k);
    return {from[0], from[kBlock], from[2 * kBlock]};
  }
  DISMANTLE_HOST_DEVICE Certificate certificate(std::size_t i) const {
    const NodeHull hull{vector(i, 4), {vector(i, 7), vector(i, 10), vector(i, 13)}, data[place(i, 16)]};
    return {vector(i, 0), data[place(i, 3)], hull};
  }
};

/// A pair of nodes to be separated.
struct BoxPairQuery {
  const ObbNode* a;
  const ObbNode* b;
  /// An axis that has used part of the allowance: it may only be left for one within a right angle of it, or where the
  /// boxes are apart; zero for none (docs/design/0006-certificates.md: open sheets remember their side).
  Vec3f guard;
  /// Of the nodes of closed solids: only an axis that leaves A and enters B through their outsides may use the
  /// allowance. Null where any may.
  const NormalCone* cone_a = nullptr;
  const NormalCone* cone_b = nullptr;
};

/// Two triangles to be separated.
struct TrianglePairQuery {
  const TriangleF* a;
  const TriangleF* b;
  Vec3f guard;          ///< As BoxPairQuery has it.
  bool facing = false;  ///< They are faces of closed solids, whose outward normals decide what may use the allowance.
};

/// The axis along which two nodes or triangles are furthest apart during a sweep, of those of their separating-axis
/// test.
struct NodeSeparation {
  /// The least gap along it during the sweep [mm], up to LinearSweep::error, before the arcs' deviation, less the
  /// allowance where it may not be used: what a check of the certificate finds.
  float gap;
  Certificate certificate;
};

/// What certificates say of a sweep.
struct CertificateCheck {
  std::size_t failing = 0;  ///< How many do not certify their pair.
  float min_gap = 3e38f;    ///< Of the others, at either end, up to LinearSweep::error [mm].
};

/// Checks certificates 0, ..., count - 1 against LinearSweep::limit, those of triangles on edge against `meeting`;
/// padded to whole blocks.
/// @param failing gets the indices of those that do not certify, ascending; room for `count`
template <int kLanes>
CertificateCheck check_certificates_kernel(const CertificateBlocks& certificates, std::size_t count,
                                           const LinearSweep& sweep, std::uint32_t* failing);

/// The separating-axis test of pairs of boxes over a whole sweep.
template <int kLanes>
void separate_boxes_kernel(const BoxPairQuery* queries, std::size_t count, const LinearSweep& sweep,
                           NodeSeparation* separations);

/// The separating-axis test of pairs of triangles over a whole sweep: 17 axes.
template <int kLanes>
void separate_triangles_kernel(const TrianglePairQuery* queries, std::size_t count, const LinearSweep& sweep,
                               NodeSeparation* separations);

/// The kernels of one lane width.
struct FrontKernels {
  CertificateCheck (*check_certificates)(const CertificateBlocks&, std::size_t, const LinearSweep&, std::uint32_t*);
  void (*separate_boxes)(const BoxPairQuery*, std::size_t, const LinearSweep&, NodeSeparation*);
  void (*separate_triangles)(const TrianglePairQuery*, std::size_t, const LinearSweep&, NodeSeparation*);
};

/// All widths give the same numbers. @pre `lanes` is one of lane_counts()
FrontKernels front_kernels(LaneCount lanes);

}  // namespace dismantle
