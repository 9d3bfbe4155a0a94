// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/audit_path.h"

#include "dismantle/audit/audit_body.h"
#include "dismantle/audit/pair_ledger.h"
#include "dismantle/audit/path_consistency.h"
#include "dismantle/audit/sweep_move.h"

#include <chrono>
#include <memory>

namespace dismantle {

namespace {

double resolution_of(const Assembly& assembly, const Path& path) {
  const double minimum = kAuditMinTolerance * diagonal(assembled_bounds(assembly));
  const double resolution = kAuditResolution * (path.tolerance > minimum ? path.tolerance : minimum);
  return resolution > 0 ? resolution : kAuditResolution * kAuditMinTolerance;
}

std::vector<std::unique_ptr<const audit::AuditBody>> make_bodies(const Assembly& assembly, const Executor& executor) {
  std::vector<std::unique_ptr<const audit::AuditBody>> bodies(assembly.components.size());
  executor.for_each_heavy(bodies.size(), [&](std::size_t c) {
    bodies[c] = std::make_unique<const audit::AuditBody>(assembly.components[c]);
  });
  return bodies;
}

void append(std::vector<AuditViolation>& to, std::vector<AuditViolation> more) {
  to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// Adds the outcome of a sweep to the report; false where it was cancelled.
bool take(audit::SweepOutcome outcome, AuditReport& report) {
  append(report.violations, std::move(outcome.violations));
  report.samples += outcome.samples;
  return !outcome.cancelled;
}

bool audit_moves(const Assembly& assembly, const Path& path, audit::SweepContext& context, AuditReport& report) {
  std::vector<Pose> poses(assembly.components.size());
  const double stages = static_cast<double>(path.moves.size()) + 1;
  if (!take(audit::sweep_assembled_state(context, 0, 1 / stages), report)) return false;
  for (std::size_t m = 0; m < path.moves.size(); ++m) {
    const Move& move = path.moves[m];
    append(report.violations, audit::check_move(assembly, path, m, poses));
    if (!audit::can_follow(move)) continue;
    const double done = static_cast<double>(m) + 1;
    if (!take(audit::sweep_move(context, poses, m, done / stages, (done + 1) / stages), report)) return false;
    for (const std::string& name : move.components)
      if (const auto id = assembly.find(name)) poses[id->value] = move.frames.back().pose;
  }
  append(report.violations, audit::check_removed(assembly, path, poses));
  return report_progress(context.progress, "audit", 1);
}

}  // namespace

AuditReport audit_path(const Assembly& assembly, const Path& path, const AuditOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  AuditReport report;
  report.tolerance = path.tolerance;
  report.resolution = resolution_of(assembly, path);
  report.violations = audit::check_declarations(assembly, path);

  const auto bodies = make_bodies(assembly, options.executor);
  audit::PairLedger ledger(assembly, path);
  audit::SweepContext context{assembly, path, bodies, ledger, report.resolution, options.executor, options.progress};
  report.complete = audit_moves(assembly, path, context, report);

  for (const auto& [pair, record] : ledger.records())
    if (record.deepest > 0)
      report.depths.push_back({ComponentId(pair.first), ComponentId(pair.second), record.deepest, record.allowed});
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace dismantle
