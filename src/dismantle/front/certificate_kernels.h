// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/obb_tree.h"
#include "dismantle/front/pair_sweep.h"
#include "dismantle/math/lane_dispatch.h"

#include <cstddef>

namespace dismantle {

/// Certificates as arrays, for lanes.
struct CertificateArrays {
  const float* axis[3];
  const float* point[3];
  const float* offset;
  const float* radius;
  const float* epoch;
};

/// A pair of nodes to be separated.
struct BoxPairQuery {
  const ObbNode* a;
  const ObbNode* b;
  /// An axis that has used part of the allowance: it may only be left for one within a right angle of it, or where the
  /// boxes are apart; zero for none (DESIGN section 5: open sheets remember their side).
  Vec3f guard;
};

/// The axis along which two boxes are furthest apart during a sweep, of the 15 of their separating-axis test.
struct BoxSeparation {
  /// A lower bound of the gap along it during the sweep [mm], before the arcs' deviation; rounding is taken off.
  float gap;
  Certificate certificate;
};

/// What certificates say of a sweep.
struct CertificateCheck {
  std::size_t failing = 0;  ///< How many do not certify their pair.
  float least_gap = 3e38f;  ///< Of the others, at either end, up to PairSweep::error [mm].
};

/// Checks certificates 0, ..., count - 1 against PairSweep::limit; the arrays are padded to whole lanes.
/// @param failing gets the indices of those that do not certify, ascending; room for `count`
template <int kLanes>
CertificateCheck check_certificates_kernel(const CertificateArrays& certificates, std::size_t count,
                                           const PairSweep& sweep, std::uint32_t* failing);

/// The separating-axis test of pairs of boxes over a whole sweep.
template <int kLanes>
void separate_boxes_kernel(const BoxPairQuery* queries, std::size_t count, const PairSweep& sweep,
                           BoxSeparation* separations);

/// The kernels of one lane width.
struct FrontKernels {
  CertificateCheck (*check_certificates)(const CertificateArrays&, std::size_t, const PairSweep&, std::uint32_t*);
  void (*separate_boxes)(const BoxPairQuery*, std::size_t, const PairSweep&, BoxSeparation*);
};

/// All widths give the same numbers. @pre `lanes` is one of lane_counts()
FrontKernels front_kernels(LaneCount lanes);

}  // namespace dismantle
