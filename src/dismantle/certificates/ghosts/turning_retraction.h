// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/surface/solid_tree.h"

#include <vector>

namespace dismantle {

/// How far facets of cylinders are to be retracted so that they turn in those of another component.
struct TurningRetraction {
  std::vector<double> needed;  ///< Of each face along its normal [mm]; 0 where none is needed.
  double largest = 0;          ///< Of all of them [mm].
};

/// The retraction of a component's facets of cylinders about an axis that it shares with another component, until no
/// corner of one meets the middle of the other's facet.
/// @param depth of the pair [mm], an upper bound
/// @param tolerance [mm]
TurningRetraction turning_retraction(const SolidTree& own, const SolidTree& other, double depth, double tolerance);

}  // namespace dismantle
