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

/// The data that all sweeps of an audit share.
struct SweepContext {
  ///@{ The arguments of the audit.
  const Assembly& assembly;
  const Path& path;
  ///@}
  const std::vector<std::unique_ptr<const AuditBody>>& bodies;  ///< Of each component.
  PairLedger& ledger;                                           ///< Updated after each move.
  double resolution = 0;                                        ///< AuditReport::resolution [mm].
  ///@{ Of AuditOptions.
  const Executor& executor;
  const ProgressCallback& progress;
  ///@}
};

/// The findings of a sweep of all pairs.
struct SweepOutcome {
  std::vector<AuditViolation> violations;  ///< By (a, b, kind).
  std::size_t samples = 0;                 ///< As in AuditReport.
  bool cancelled = false;                  ///< The findings are not complete.
};

/// Checks all pairs in the assembled state and records in the ledger which vertices are inside other components.
/// Reports progress from `progress_from` to `progress_to`.
SweepOutcome sweep_assembled_state(SweepContext& context, double progress_from, double progress_to);

/// Checks all pairs of a moving and a stationary component in move `index`. @param poses of all components before it
/// @pre can_follow(the move)
SweepOutcome sweep_move(SweepContext& context, Span<const Pose> poses, std::size_t index, double progress_from,
                        double progress_to);

}  // namespace dismantle::audit
