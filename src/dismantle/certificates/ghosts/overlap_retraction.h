// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/surface/solid_shape.h"
#include "dismantle/surface/solid_tree.h"

#include <functional>
#include <vector>

namespace dismantle {

/// One of two components that overlap in the assembled state.
struct OverlapSide {
  const SolidTree* tree = nullptr;                ///< Never null.
  std::function<const SolidShape&()> make_shape;  ///< The same component; called where it is needed, often.

  /// The same component.
  const SolidShape& shape() const { return make_shape(); }
};

/// How far the faces of a component are to be retracted.
struct OverlapRetraction {
  std::vector<double> needed;        ///< Of each face along its normal [mm]; 0 where it does not overlap.
  std::vector<std::uint32_t> patch;  ///< The smooth patch of each face: one of its faces.
  double turning = 0;                ///< The largest one that cylinders need to turn in each other [mm].
};

/// How far each face of a component has to be retracted so that the component and another one do not overlap in the
/// assembled state any more, nor when one slides along or turns in the other. Faces of one smooth patch, whose
/// neighbours differ by less than kSmoothAngle, are retracted by the same distance. Facets of cylinders about a common
/// axis are retracted until they turn in each other. Found at sampled points: a start for ghost surfaces, whose
/// separation has to be tested.
/// @param depth of the pair [mm], an upper bound
/// @param tolerance depths below a tenth of it do not count [mm]
OverlapRetraction overlap_retraction(const OverlapSide& own, const OverlapSide& other, double depth, double tolerance);

/// The larger OverlapRetraction::turning of two components, without the rest.
double turning_retraction(const OverlapSide& a, const OverlapSide& b, double depth, double tolerance);

/// Neighbouring faces that differ by less belong to one smooth patch [rad].
inline constexpr double kSmoothAngle = 0.5235987755982988;

}  // namespace dismantle
