// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"
#include "dismantle/exec/executor.h"

namespace dismantle {

/// The rule that classifies intersecting pairs.
enum class ClassifyRule {
  Auto,   ///< Contact, Fit or Embedded by depth (docs/guarantee.md).
  Paper,  ///< Every pair that intersects or touches is Embedded: the paper's S_i.
};

/// Options of classify_pairs().
struct ClassifyOptions {
  double tolerance = 0;  ///< Depth that counts as touching [mm]; 0: default_tolerance(assembly).
  double fit = 0;        ///< Largest depth of a Fit [mm]; 0: kDefaultRelativeFit of the smaller component's diagonal.
  double clearance = 0;  ///< Pairs that are apart by less than this are listed as Near [mm].
  ClassifyRule rule = ClassifyRule::Auto;  ///< For pairs that intersect.
  Executor executor;                       ///< Runs the pairs; the result does not depend on it.
  ProgressCallback progress;               ///< Called under a lock, from any thread; false cancels.
};

/// The largest depth of a fit relative to the smaller component's bounding-box diagonal.
inline constexpr double kDefaultRelativeFit = 0.01;

/// Classifies every pair of components in the assembled state. Each pair that is not Clear is listed with the number of
/// its intersecting triangle pairs and their largest depth, or else with its distance. The allowance covers what an
/// audit measures too: vertices of one component inside a closed other one may be twice as deep as the allowance. A
/// component that lies inside another without touching its surface is Embedded. The result depends on the assembly and
/// the options alone. Errors: Failed where `progress` cancelled.
Result<PairStates> classify_pairs(const Assembly& assembly, const ClassifyOptions& options);

}  // namespace dismantle
