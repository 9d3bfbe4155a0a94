// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/sweep/certificate_sweeper.h"

#include <vector>

/// The working memory of sweeps: for the sweeper's own sources.
namespace dismantle {

/// The sweep of one moving component past one fixed component.
struct CertificateSweeper::PairSweep {
  ComponentId moving, fixed;
  CertificateFront* front;           ///< Their stored front; null in sweeps that leave fronts unchanged.
  TrianglePairSweep triangle_pairs;  ///< The tests of their triangles.
  PreparedSweep sweep;               ///< Their motion for the front.
  double allowed;                    ///< [mm]
  bool free = true;                  ///< As far as is known by now.
};

/// The sweep of one part of one front, and its result.
struct CertificateSweeper::PartTask {
  std::size_t pair, part;
  double horizon = 1;  ///< Contacts after this time do not matter.
  FrontSweep found;
  std::vector<BlockedPair> blocked;
  std::size_t device_tests = 0;
};

/// Sorts by components and faces.
void sort_blocked(std::vector<BlockedPair>& pairs);

}  // namespace dismantle
