// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/obb_tree.h"
#include "dismantle/certificates/front/linear_sweep.h"
#include "dismantle/math/lane_dispatch.h"

#include <cstddef>

namespace dismantle {

/// Certificates in an array of structures of arrays: blocks of kBlock certificates, each field of a block contiguous. A
/// certificate's memory lies close together, and lanes load contiguous floats.
struct CertificateBlocks {
  static constexpr std::size_t kBlock = 16;   ///< Certificates in a block.
  static constexpr std::size_t kFields = 17;  ///< Axis, offset, the hull's center, its three spans, its kind.
  const float* data = nullptr;                ///< Whole blocks.

  /// Index in `data` of field `k` of certificate `i`.
  DISMANTLE_HOST_DEVICE static constexpr std::size_t index(std::size_t i, std::size_t k) {
    return (i / kBlock * kFields + k) * kBlock + i % kBlock;
  }

  /// The vector of the fields k, k + 1, k + 2 of certificate `i`.
  DISMANTLE_HOST_DEVICE Vec3f vector(std::size_t i, std::size_t k) const {
    const float* from = data + index(i, k);
    return {from[0], from[kBlock], from[2 * kBlock]};
  }
  /// Certificate `i`.
  DISMANTLE_HOST_DEVICE Certificate certificate(std::size_t i) const {
    const NodeHull hull{vector(i, 4), {vector(i, 7), vector(i, 10), vector(i, 13)}, data[index(i, 16)]};
    return {vector(i, 0), data[index(i, 3)], hull};
  }
};

/// Input of the separating-axis test of two nodes' boxes.
struct BoxPairQuery {
  const ObbNode* a;  ///< Node of the moving component.
  const ObbNode* b;  ///< Node of the fixed component.
};

/// Input of the separating-axis test of two triangles.
struct TrianglePairQuery {
  const TriangleF* a;  ///< Triangle of the moving component.
  const TriangleF* b;  ///< Triangle of the fixed component.
};

/// Result of a separating-axis test over a sweep: the axis with the largest gap.
struct NodeSeparation {
  /// The smallest gap along the axis during the sweep [mm], up to LinearSweep::error, before the arcs' deviation: the
  /// value that a check of the certificate computes.
  float gap;
  Certificate certificate;  ///< Of that axis.
};

/// Result of checking certificates against a sweep.
struct CertificateCheck {
  std::size_t failing = 0;  ///< Number of certificates that do not hold.
  float min_gap = 3e38f;    ///< Smallest gap of those that hold, at either end, up to LinearSweep::error [mm].
};

/// Checks certificates 0, ..., count - 1 against LinearSweep::limit. The certificates are padded to whole blocks.
/// @param failing receives the indices of those that do not hold, ascending; room for `count`
template <int kLanes>
CertificateCheck check_certificates_kernel(const CertificateBlocks& certificates, std::size_t count,
                                           const LinearSweep& sweep, std::uint32_t* failing);

/// The separating-axis test of pairs of boxes over a whole sweep: 15 axes.
/// @param separations receives `count` results
template <int kLanes>
void separate_boxes_kernel(const BoxPairQuery* queries, std::size_t count, const LinearSweep& sweep,
                           NodeSeparation* separations);

/// The separating-axis test of pairs of triangles over a whole sweep: 17 axes.
/// @param separations receives `count` results
template <int kLanes>
void separate_triangles_kernel(const TrianglePairQuery* queries, std::size_t count, const LinearSweep& sweep,
                               NodeSeparation* separations);

/// The three kernels above for one lane width.
struct FrontKernels {
  ///@{ As the kernel of that name.
  CertificateCheck (*check_certificates)(const CertificateBlocks&, std::size_t, const LinearSweep&, std::uint32_t*);
  void (*separate_boxes)(const BoxPairQuery*, std::size_t, const LinearSweep&, NodeSeparation*);
  void (*separate_triangles)(const TrianglePairQuery*, std::size_t, const LinearSweep&, NodeSeparation*);
  ///@}
};

/// The kernels for a lane width; all widths give the same bits. @pre `lanes` is one of lane_counts()
FrontKernels front_kernels(LaneCount lanes);

}  // namespace dismantle
