// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/path.h"
#include "dismantle/audit/audit_report.h"
#include "dismantle/core/progress.h"
#include "dismantle/exec/executor.h"

namespace dismantle {

/// The resolution of an audit relative to the tolerance: between two samples that no certificate covers, a pair moves
/// by at most the resolution.
inline constexpr double kAuditResolution = 0.1;

/// The smallest tolerance from which the resolution is computed, relative to the assembly's diagonal: with a tolerance
/// of 0 the distance of samples would be 0.
inline constexpr double kAuditMinTolerance = 1e-7;

/// Options of audit_path().
struct AuditOptions {
  Executor executor;          ///< The report does not depend on it, apart from the time.
  ProgressCallback progress;  ///< Returning false cancels: the report is not complete then.
};

/// Checks the guarantee of docs/formats.md, "Path", for a path of an assembly. It shares no code with what makes paths:
/// every screw motion is sampled densely in time, with steps that certified separating axes lengthen
/// (docs/design/0002-audit.md). The allowance of a pair is the tolerance or its own.
///   1. If the report holds, the depth of two triangles of different components was never above their allowance plus
///   half
///      the resolution, and no vertex was deeper inside a closed component than twice the allowance plus that.
///   2. A violation that is reported occurred at a sample, beyond rounding.
///   3. At the frames and in the assembled state the decision is exact up to rounding.
/// An embedded pair parts at the first frame at which all its triangles are further apart than the resolution and
/// neither component is inside the other; from then on it is an ordinary pair.
AuditReport audit_path(const Assembly& assembly, const Path& path, const AuditOptions& options = {});

}  // namespace dismantle
