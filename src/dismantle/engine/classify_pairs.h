// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/clash.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"
#include "dismantle/core/span.h"
#include "dismantle/exec/executor.h"

#include <string>
#include <vector>

namespace dismantle {

/// The rule for pairs that touch or overlap in the assembled state.
enum class ClassifyRule {
  Auto,   ///< They get no deeper (docs/guarantee.md).
  Paper,  ///< They are Free until they have been apart: the paper's S_i.
};

/// Depth that the user allows two components: one of them is flexible, or drawn wrong.
struct DeclaredAllowance {
  ///@{ Names of the components, in either order.
  std::string a, b;
  ///@}
  double depth = 0;  ///< Allowed until the two have been apart [mm].
  friend bool operator==(const DeclaredAllowance&, const DeclaredAllowance&) = default;
};

/// Options of classify_pairs().
struct ClassifyOptions {
  double tolerance = 0;                     ///< Depth that counts as touching [mm]; 0: default_tolerance(assembly).
  double clearance = 0;                     ///< Pairs that are apart by less than this are listed as Near [mm].
  ClassifyRule rule = ClassifyRule::Auto;   ///< For pairs that touch or overlap.
  std::vector<DeclaredAllowance> declared;  ///< Larger allowances of pairs that touch or overlap.
  Executor executor;                        ///< Runs the pairs; the result does not depend on it.
  ProgressCallback progress;                ///< Called under a lock, from any thread; false cancels.
};

/// Classifies every pair of components in the assembled state by the depth of solids (find_clashes()). Each pair that
/// is not Clear is listed with its depth, or else with its distance. The result depends on the assembly and the options
/// alone. Errors: Failed where `progress` cancelled; those of declare_allowances().
Result<PairStates> classify_pairs(const Assembly& assembly, const ClassifyOptions& options);

/// The states of the pairs whose depths are known.
PairStates pair_states(const Clashes& clashes, ClassifyRule rule);

/// Gives pairs that touch or overlap allowances that the user declares, where these are larger than their own. Free
/// pairs stay so. Errors: Usage where there is no such component or the two are apart in the assembled state: an
/// allowance ends where they have been apart.
Result<Done> declare_allowances(PairStates& states, const Assembly& assembly, Span<const DeclaredAllowance> declared);

/// Contact that is deeper than this share of the tolerance has the depth plus the tolerance for its allowance, as an
/// overlap has: the tolerance alone would leave it no play.
inline constexpr double kShallow = 0.1;

}  // namespace dismantle
