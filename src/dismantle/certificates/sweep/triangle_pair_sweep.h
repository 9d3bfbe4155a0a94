// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/certificate_front.h"
#include "dismantle/certificates/sweep/triangle_pair_sweep_kernel.h"
#include "dismantle/math/screw.h"
#include "dismantle/surface/solid_tree.h"

namespace dismantle {

/// How far the linear vertex paths that decide a triangle pair may be from the true screw, as a share of the tolerance:
/// longer motions are cut. The share is taken off every allowance whatever the motion, so that a state reached by a
/// translation is not too deep for a rotation.
inline constexpr double kArcShare = 0.125;

/// The sweep of one moving component past one fixed component along a screw, seen from the fixed one: tests pairs of
/// their triangles on the chords of the true arcs, and takes the arcs' deviation off the allowance.
class TrianglePairSweep {
 public:
  /// @param start, end poses of the moving component in the fixed one's frame; the motion is the one screw between
  /// @param deviation upper bound of the distance of any arc of the moving component from its chord [mm]; what is more
  /// than kArcShare of the tolerance costs allowance that may be in use already
  /// @pre deviation is less than the allowance
  TrianglePairSweep(const SolidTree& moving, const SolidTree& fixed, const Pose& start, const Pose& end,
                    double deviation, const TrianglePairRules& rules);

  /// As the front takes it.
  PairMotion motion() const;

  /// Guarantee: see ccd_triangle_triangle; for the screw itself.
  /// @param horizon looks no further into the motion than this time: free is free until then
  TrianglePairResult test(std::uint32_t face_moving, std::uint32_t face_fixed, Vec3 hint, double horizon = 1) const;

  /// For a device: what tests, over solids in the host's memory, and these.
  const TrianglePairSweepKernel& kernel() const { return kernel_; }
  const SolidTree& moving() const { return *moving_; }
  const SolidTree& fixed() const { return *fixed_; }

  /// What the axis of a test proves of the two triangles, for the front. @param sweep of this motion
  Certificate certificate(const TrianglePairResult& found, const LinearSweep& sweep) const;

 private:
  const SolidTree* moving_;
  const SolidTree* fixed_;
  TrianglePairSweepKernel kernel_;
  Pose start_pose_, end_pose_;
  double share_;
};

}  // namespace dismantle
