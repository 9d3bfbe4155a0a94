// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/path.h"
#include "dismantle/audit/audit_report.h"
#include "dismantle/core/progress.h"
#include "dismantle/exec/executor.h"

namespace dismantle {

/// Between two samples of an audit that no certificate covers, a pair moves by at most this part of the tolerance.
inline constexpr double kAuditResolution = 0.1;

/// The least tolerance that the audit's resolution goes by, relative to the assembly's diagonal: with a tolerance of 0
/// samples would otherwise be infinitely close.
inline constexpr double kAuditMinTolerance = 1e-7;

struct AuditOptions {
  Executor executor;          ///< The report is the same for every one, but for the time.
  ProgressCallback progress;  ///< Cancelling leaves a report that is not complete.
};

/// Checks the guarantee of docs/formats.md, "Path", for a path of an assembly, by means that it shares with nothing
/// that makes paths: it follows every screw by dense samples in time, whose steps certified separating axes lengthen
/// (docs/design/0002-audit.md). With the allowance the tolerance or the pair's own:
///   1. Where it holds, no two triangles of different components were ever deeper in each other than their allowance
///      plus half the resolution, and no vertex deeper inside a closed component than twice the allowance plus that.
///   2. What it reports was really seen, at a sample, deeper than allowed (beyond rounding).
///   3. At the frames themselves, and in the assembled state, the decision is exact to rounding.
/// An embedded pair counts as apart from the first frame at which all its triangles are further apart than the
/// resolution and neither component is inside the other; from then on it is ordinary.
AuditReport audit_path(const Assembly& assembly, const Path& path, const AuditOptions& options = {});

}  // namespace dismantle
