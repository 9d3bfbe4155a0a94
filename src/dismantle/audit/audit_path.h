// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/path.h"
#include "dismantle/audit/audit_report.h"
#include "dismantle/core/progress.h"
#include "dismantle/exec/executor.h"

#include <memory>

namespace dismantle {

/// The slack of an audit relative to the tolerance.
inline constexpr double kAuditSlack = 0.1;

/// The smallest tolerance from which the slack is computed, relative to the assembly's diagonal: with a tolerance of 0
/// there would be none.
inline constexpr double kAuditMinTolerance = 1e-7;

/// Options of audit_path().
struct AuditOptions {
  Executor executor;          ///< The report does not depend on it, apart from the time.
  ProgressCallback progress;  ///< Returning false cancels: the report is not complete then.
};

/// Checks by the definition that nothing in a path gets deeper than allowed (docs/guarantee.md,
/// docs/design/0011-audit.md). The depth of a point of a surface inside another component is its distance
/// from that component's surface; inside is where the winding number is more than 1/2 in magnitude. The allowance of a
/// pair is the tolerance; for a pair that is deeper than that in the assembled state, that depth plus the tolerance,
/// or what the path allows if that is less, until it has been apart at a frame. The audit computes the depths in the
/// assembled state itself: a path that claims or allows more than they justify is inconsistent, and so is one that does
/// not list a pair that overlaps. `Declared` pairs are allowed what the path declares, `Free` pairs anything, until
/// they have been apart; the report lists them.
///   1. If the report holds, no point of any surface was deeper inside another component than the allowance plus the
///      slack, at any instant of any screw.
///   2. A depth that is reported as a violation was found at a point and an instant, more than half the slack above the
///      allowance.
///   3. Components that bound no volume (sheets) have no inside. Where one component of a pair is a sheet, or thinner
///      than four tolerances, points of both surfaces are followed in time: none goes through the other surface by more
///      than the allowance plus the slack (AuditViolationKind::Crossing). What passes between these points is not seen.
///      For pairs that overlap in the assembled state, where a component has walls thinner than twice the allowance,
///      points that are not within the allowance there are followed, and go through by no more than twice the
///      allowance plus the slack, but for holes (docs/design/0011-audit.md).
/// It shares no collision code with what makes paths.
AuditReport audit_path(const Assembly& assembly, const Path& path, const AuditOptions& options = {});

/// Audits many paths of one assembly: its solids are built once, and the depths in the assembled state are found once
/// for all paths of the same tolerance and free pairs. Several threads may audit at the same time.
class PathAuditor {
 public:
  /// @param assembly must live as long as the auditor
  explicit PathAuditor(const Assembly& assembly, const Executor& executor = {});
  ~PathAuditor();
  /// Takes over what `other` knows; `other` must not be used afterwards.
  PathAuditor(PathAuditor&& other) noexcept;
  /// Replaces what is known by what `other` knows; `other` must not be used afterwards.
  PathAuditor& operator=(PathAuditor&& other) noexcept;

  /// The report of audit_path(), apart from the time.
  AuditReport audit(const Path& path, const AuditOptions& options = {}) const;

 private:
  struct Known;
  const Assembly* assembly_;
  std::unique_ptr<Known> known_;
};

}  // namespace dismantle
