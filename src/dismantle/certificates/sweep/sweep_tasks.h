// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/sweep/certificate_sweeper.h"
#include "dismantle/engine/chords.h"

#include <limits>
#include <vector>

/// The working memory of sweeps: for the sweeper's own sources.
namespace dismantle {

/// The sweep of one moving component past one fixed component.
struct CertificateSweeper::PairSweep {
  TestedPair tested;                 ///< The components and their surfaces.
  CertificateFront* front;           ///< Their stored front; null in sweeps that leave fronts unchanged.
  TrianglePairSweep triangle_pairs;  ///< The tests of their triangles.
  PreparedSweep sweep;               ///< Their motion for the front.
  double displaced;                  ///< Largest displacement of their ghost surfaces [mm].
  bool free = true;                  ///< As far as is known by now.
  double apart_by = std::numeric_limits<double>::infinity();  ///< As clearance() of all parts [mm].

  /// Lower bound of the distance of the two components during the sweep, from a part's result [mm]: a ghost surface may
  /// be farther away than the surface itself by the length of its displacements.
  double clearance(const FrontSweep& found) const {
    return static_cast<double>(found.min_gap) - static_cast<double>(sweep.error) - displaced;
  }
};

/// The sweep of one part of one front, and its result.
struct CertificateSweeper::PartTask {
  std::size_t pair;                   ///< Index of the PairSweep.
  std::size_t part;                   ///< Index of the part in its front.
  double horizon = 1;                 ///< Contacts after this time do not matter.
  FrontSweep found;                   ///< Result of the front.
  std::vector<SweepContact> blocked;  ///< Triangle pairs that block the motion.
  std::size_t device_tests = 0;       ///< Triangle-pair tests that a device made.
};

/// `pose` in the frame of something at `frame`; exact if that is the assembled pose.
inline Pose seen_from(const Pose& frame, const Pose& pose) {
  return frame == Pose{} ? pose : inverse(frame) * pose;
}

/// Sorts by components and faces.
void sort_blocked(std::vector<SweepContact>& pairs);

}  // namespace dismantle
