// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/path.h"
#include "dismantle/audit/depth_audit.h"
#include "dismantle/core/progress.h"
#include "dismantle/exec/executor.h"

namespace dismantle {

/// The slack of an audit of depths relative to the tolerance.
inline constexpr double kDepthAuditSlack = 0.1;

/// Options of audit_depth().
struct DepthAuditOptions {
  Executor executor;          ///< The report does not depend on it, apart from the time.
  ProgressCallback progress;  ///< Returning false cancels: the report is not complete then.
};

/// Checks by the definition that nothing in a path gets deeper than allowed (docs/design/0011-audit-of-solids.md).
/// The depth of a point of a surface inside another component is its distance from that component's surface; inside is
/// where the winding number is more than 1/2 in magnitude. The allowance of a pair is the tolerance; for a pair that is
/// deeper than that in the assembled state, that depth plus the tolerance, until it has been apart at a frame. States
/// and allowances that the path declares are ignored.
///   1. If the report holds, no point of any surface was deeper inside another component than the allowance plus the
///      slack, at any instant of any screw.
///   2. A depth that is reported as a violation was found at a point and an instant, more than half the slack above the
///      allowance.
///   3. Components that bound no volume (sheets) have no inside. Where one component of a pair is a sheet, or thinner
///      than four tolerances, points of both surfaces are followed in time: none goes through the other surface by more
///      than the allowance plus the slack (DepthRule::Crossing). What passes between these points is not seen.
/// It shares no code with what makes paths, and nothing with audit_path() but the reading of motions and trees of
/// boxes.
DepthAudit audit_depth(const Assembly& assembly, const Path& path, const DepthAuditOptions& options = {});

}  // namespace dismantle
