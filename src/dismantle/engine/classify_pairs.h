// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/clash.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"
#include "dismantle/exec/executor.h"

namespace dismantle {

/// The rule for pairs that touch or overlap in the assembled state.
enum class ClassifyRule {
  Auto,   ///< They get no deeper (docs/guarantee.md).
  Paper,  ///< They are Free until they have been apart: the paper's S_i.
};

/// Options of classify_pairs().
struct ClassifyOptions {
  double tolerance = 0;                    ///< Depth that counts as touching [mm]; 0: default_tolerance(assembly).
  double clearance = 0;                    ///< Pairs that are apart by less than this are listed as Near [mm].
  ClassifyRule rule = ClassifyRule::Auto;  ///< For pairs that touch or overlap.
  Executor executor;                       ///< Runs the pairs; the result does not depend on it.
  ProgressCallback progress;               ///< Called under a lock, from any thread; false cancels.
};

/// Classifies every pair of components in the assembled state by the depth of solids (find_clashes()). Each pair that
/// is not Clear is listed with its depth, or else with its distance. The result depends on the assembly and the options
/// alone. Errors: Failed where `progress` cancelled.
Result<PairStates> classify_pairs(const Assembly& assembly, const ClassifyOptions& options);

/// The states of the pairs whose depths are known.
PairStates pair_states(const Clashes& clashes, ClassifyRule rule);

}  // namespace dismantle
