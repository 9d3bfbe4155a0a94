// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/sweep/certificate_sweeper.h"

#include <vector>

/// The working memory of sweeps: for the sweeper's own sources.
namespace dismantle {

/// The sweep of one moving component past one fixed component.
struct CertificateSweeper::PairSweep {
  ComponentId moving;                ///< A component of the moving set.
  ComponentId fixed;                 ///< The other component.
  CertificateFront* front;           ///< Their stored front; null in sweeps that leave fronts unchanged.
  TrianglePairSweep triangle_pairs;  ///< The tests of their triangles.
  PreparedSweep sweep;               ///< Their motion for the front.
  double allowed;                    ///< [mm]
  bool free = true;                  ///< As far as is known by now.
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

/// Sorts by components and faces.
void sort_blocked(std::vector<SweepContact>& pairs);

}  // namespace dismantle
