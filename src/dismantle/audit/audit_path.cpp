// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/audit_path.h"

#include "dismantle/audit/path_consistency.h"
#include "dismantle/audit/solid/move_depths.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace dismantle {

namespace {

double slack_of(const Assembly& assembly, const Path& path) {
  const double minimum = kAuditMinTolerance * diagonal(assembled_bounds(assembly));
  const double slack = kAuditSlack * std::max(path.tolerance, minimum);
  return slack > 0 ? slack : kAuditSlack * kAuditMinTolerance;
}

void append(std::vector<AuditViolation>& to, std::vector<AuditViolation> more) {
  to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

bool audit_moves(audit::DepthContext& context, AuditReport& report) {
  const Assembly& assembly = context.assembly;
  const Path& path = context.path;
  std::vector<Pose> poses(assembly.components.size());
  const double stages = static_cast<double>(path.moves.size()) + 1;
  if (!audit::find_initial_depths(context, 0, 1 / stages)) return false;
  append(report.violations, audit::apply_path_pairs(context));
  for (std::size_t m = 0; m < path.moves.size(); ++m) {
    const Move& move = path.moves[m];
    append(report.violations, audit::check_move(assembly, path, m, poses));
    if (!audit::can_follow(move)) continue;
    const double done = static_cast<double>(m) + 1;
    if (!audit::check_move_depths(context, poses, m, done / stages, (done + 1) / stages)) return false;
    for (const std::string& name : move.components)
      if (const auto id = assembly.find(name)) poses[id->value] = move.frames.back().pose;
  }
  append(report.violations, audit::check_removed(assembly, path, poses));
  return report_progress(context.progress, "audit", 1);
}

std::string message_of(const Assembly& assembly, const audit::LedgerEntry& entry) {
  const AuditViolation& v = entry.violation;
  const std::string& moving = assembly[v.point_of_a ? v.a : v.b].name;
  const std::string& other = assembly[v.point_of_a ? v.b : v.a].name;
  const bool depth = v.kind == AuditViolationKind::Depth;
  char text[256];
  std::snprintf(text, sizeof text,
                "%.6g mm (allowed: %.6g mm%s) at %.6g s of move %zu (after frame %zu), at (%.6g, %.6g, %.6g)", v.depth,
                v.allowed, entry.pair.parted && v.allowed < entry.pair.allowed ? ", as they have been apart" : "",
                v.time, v.move + 1, v.frame, v.point.x, v.point.y, v.point.z);
  char greatest[64] = "";
  if (v.greatest > v.depth) std::snprintf(greatest, sizeof greatest, "; up to %.6g mm", v.greatest);
  return "\"" + moving + (depth ? "\" is inside \"" : "\" went through \"") + other + "\": " + text + greatest;
}

}  // namespace

AuditReport audit_path(const Assembly& assembly, const Path& path, const AuditOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  AuditReport report;
  report.tolerance = path.tolerance;
  report.slack = slack_of(assembly, path);
  report.violations = audit::check_declarations(assembly, path);

  audit::DepthContext context{assembly, path, {}, {}, {}, report.slack, 0, options.executor, options.progress};
  context.bodies.resize(assembly.components.size());
  options.executor.for_each_heavy(context.bodies.size(), [&](std::size_t c) {
    context.bodies[c] = std::make_unique<const audit::SolidBody>(assembly.components[c]);
  });
  report.complete = audit_moves(context, report);

  for (const auto& body : context.bodies) report.sheets += body->solid() ? 0 : 1;
  report.pieces = context.pieces;
  for (auto& [key, entry] : context.ledger) {
    if (entry.listed()) report.pairs.push_back(entry.pair);
    if (!entry.violated) continue;
    entry.violation.message = message_of(assembly, entry);
    report.violations.push_back(entry.violation);
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace dismantle
