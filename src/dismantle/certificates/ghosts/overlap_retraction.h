// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/ghosts/overlap_samples.h"
#include "dismantle/certificates/ghosts/turning_retraction.h"

#include <optional>
#include <vector>

namespace dismantle {

/// How far the faces of a component are to be retracted.
struct OverlapRetraction {
  std::vector<double> needed;        ///< Of each face along its normal [mm]; 0 where it does not overlap.
  std::vector<std::uint32_t> patch;  ///< The smooth patch of each face: one of its faces.
  double turning = 0;                ///< The largest one that cylinders need to turn in each other [mm].
};

/// How far the faces of two components have to be retracted so that the two do not overlap in the assembled state any
/// more, nor when one slides along or turns in the other. Faces of one smooth patch, whose neighbours differ by less
/// than kSmoothAngle, are retracted by the same distance. Facets of cylinders about a common axis are retracted until
/// they turn in each other. Found at sampled points: a start for ghost surfaces, whose separation has to be tested.
class PairOverlap {
 public:
  /// @param a, b outlive this
  /// @param depth of the pair [mm], an upper bound
  /// @param tolerance depths below a tenth of it do not count [mm]
  PairOverlap(const OverlapSide& a, const OverlapSide& b, double depth, double tolerance);

  /// The largest retraction that cylinders of the two need to turn in each other [mm]; 0 where none do.
  double turning() const;
  /// The retraction of one of the two when it is retracted alone; found when it is first wanted, as most pairs need
  /// none.
  const OverlapRetraction& retraction(bool of_a);

 private:
  const OverlapSide* sides_[2];
  double depth_, tolerance_;
  TurningRetraction turning_[2];
  std::optional<SurfaceEdges> edges_[2];
  std::optional<OverlapSamples> samples_[2];  // of each one's surface in the other one
  std::optional<OverlapRetraction> retractions_[2];
};

/// Neighbouring faces that differ by less belong to one smooth patch [rad].
inline constexpr double kSmoothAngle = 0.5235987755982988;

}  // namespace dismantle
