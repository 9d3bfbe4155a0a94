// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/certificate_front.h"
#include "dismantle/certificates/sweep/triangle_pair_sweep_kernel.h"
#include "dismantle/engine/chords.h"
#include "dismantle/math/screw.h"
#include "dismantle/surface/solid_tree.h"

namespace dismantle {

/// The sweep of one moving component past one fixed component along a screw, in the frame of the fixed one: tests pairs
/// of their triangles on the chords of the true arcs. Either of the two may be a ghost surface.
class TrianglePairSweep {
 public:
  /// @param start, end poses of the moving component in the fixed one's frame; the motion is the one screw between
  /// @param deviation upper bound of the distance of any arc of the moving component from its chord [mm]
  /// @pre it is at most kArcShare of the tolerance, which the displacements of ghost surfaces leave
  TrianglePairSweep(const SolidTree& moving, const SolidTree& fixed, const Pose& start, const Pose& end,
                    double deviation, double tolerance, const AdvancementLimits& limits = {});

  /// The motion in the form that fronts use.
  PairMotion motion() const;

  /// Tests two triangles. Guarantee: as ccd_triangle_triangle(), for the screw itself; with ghost surfaces for a ghost
  /// that is displaced by the arcs' deviation besides (docs/design/0012-ghost-surfaces.md).
  /// @param hint axis to start with, from the moving to the fixed triangle; zero for none
  /// @param horizon tests the motion on [0, horizon] only: free means free until then
  TrianglePairResult test(std::uint32_t face_moving, std::uint32_t face_fixed, Vec3 hint, double horizon = 1) const;

  ///@{ For a device: the test over solids in the host's memory, and these solids.
  const TrianglePairSweepKernel& kernel() const { return kernel_; }
  const SolidTree& moving() const { return *moving_; }
  const SolidTree& fixed() const { return *fixed_; }
  ///@}

  /// The certificate of the axis that a test ended with.
  Certificate certificate(const TrianglePairResult& found) const;

 private:
  const SolidTree* moving_;
  const SolidTree* fixed_;
  TrianglePairSweepKernel kernel_;
  Pose start_pose_, end_pose_;
  double share_;
};

}  // namespace dismantle
