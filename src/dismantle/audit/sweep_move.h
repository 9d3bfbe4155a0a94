// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/path.h"
#include "dismantle/audit/audit_body.h"
#include "dismantle/audit/audit_report.h"
#include "dismantle/audit/pair_ledger.h"
#include "dismantle/core/progress.h"
#include "dismantle/core/span.h"
#include "dismantle/exec/executor.h"

#include <memory>
#include <vector>

namespace dismantle::audit {

/// What all sweeps of an audit share.
struct SweepContext {
  const Assembly& assembly;
  const Path& path;
  const std::vector<std::unique_ptr<const AuditBody>>& bodies;  ///< One a component.
  PairLedger& ledger;
  double resolution = 0;  ///< [mm]
  const Executor& executor;
  const ProgressCallback& progress;
};

/// What a sweep of all pairs found.
struct SweepOutcome {
  std::vector<AuditViolation> violations;  ///< By (a, b, kind).
  std::size_t samples = 0;
  bool cancelled = false;
};

/// Looks at all pairs in the assembled state, and takes down in the ledger what is inside what. Progress goes from
/// `progress_from` to `progress_to`.
SweepOutcome sweep_assembled_state(SweepContext& context, double progress_from, double progress_to);

/// Looks at all pairs of which one moves in move `index`. @param poses of all components before it
/// @pre can_follow(the move)
SweepOutcome sweep_move(SweepContext& context, Span<const Pose> poses, std::size_t index, double progress_from,
                        double progress_to);

}  // namespace dismantle::audit
