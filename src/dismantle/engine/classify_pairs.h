// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"
#include "dismantle/exec/executor.h"

namespace dismantle {

/// Which rule says what an intersecting pair may do.
enum class ClassifyRule {
  Auto,   ///< Contact, Fit or Embedded by depth (docs/guarantee.md).
  Paper,  ///< Every pair that intersects or touches is Embedded: the paper's S_i.
};

struct ClassifyOptions {
  double tolerance = 0;  ///< [mm]; 0: default_tolerance(assembly)
  double fit = 0;  ///< Deepest overlap that is a Fit [mm]; 0: kDefaultRelativeFit of the smaller component's diagonal.
  double clearance = 0;  ///< Pairs apart by at most this are listed as Near [mm].
  ClassifyRule rule = ClassifyRule::Auto;
  Executor executor;
  ProgressCallback progress;
};

/// The deepest overlap that counts as a fit, as a share of the smaller component's bounding-box diagonal.
inline constexpr double kDefaultRelativeFit = 0.01;

/// Finds how every pair of components stands in the assembled state. For each pair: does it intersect, in how many
/// triangle pairs, how deep (the largest depth of a triangle pair), or else how far apart. The allowance also covers
/// what an audit measures: vertices of one component inside the other, closed one, may be twice as deep as the
/// allowance. A component that lies inside another without touching its surface is Embedded. Errors: Failed where
/// `progress` cancelled.
Result<PairStates> classify_pairs(const Assembly& assembly, const ClassifyOptions& options);

}  // namespace dismantle
