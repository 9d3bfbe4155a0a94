// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/audit_path.h"

#include "dismantle/audit/path_consistency.h"
#include "dismantle/audit/solid/move_depths.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <mutex>
#include <tuple>

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

/// Progress runs from 0 to 1 over the assembled state and the moves, in equal parts.
double stages_of(const Path& path) {
  return static_cast<double>(path.moves.size()) + 1;
}

bool audit_moves(audit::DepthContext& context, AuditReport& report) {
  const Assembly& assembly = context.assembly;
  const Path& path = context.path;
  std::vector<Pose> poses(assembly.components.size());
  const double stages = stages_of(path);
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

/// The data that all audits of an assembly share.
struct PathAuditor::Known {
  /// The arguments on which the depths in the assembled state depend, besides the assembly.
  struct Key {
    double tolerance = 0, slack = 0;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> free;
    friend bool operator<(const Key& p, const Key& q) {
      return std::tie(p.tolerance, p.slack, p.free) < std::tie(q.tolerance, q.slack, q.free);
    }
  };

  /// The depths in the assembled state, found now unless an audit has found them; null where that was cancelled. The
  /// search runs unlocked: it may use threads that begin another audit. Audits that begin together find the same.
  const audit::InitialDepths* initial_depths(const audit::DepthContext& context, double progress_to) {
    Key key{context.path.tolerance, context.slack, audit::free_pairs(context.assembly, context.path)};
    {
      const std::lock_guard lock(mutex);
      if (const auto known = depths.find(key); known != depths.end()) return &known->second;
    }
    std::optional<audit::InitialDepths> found = audit::find_initial_depths(context, key.free, 0, progress_to);
    if (!found) return nullptr;
    const std::lock_guard lock(mutex);
    return &depths.emplace(std::move(key), std::move(*found)).first->second;
  }

  std::vector<std::unique_ptr<const audit::SolidBody>> bodies;
  audit::KnownWalls walls;
  std::mutex mutex;
  std::map<Key, audit::InitialDepths> depths;
};

PathAuditor::PathAuditor(const Assembly& assembly, const Executor& executor)
    : assembly_(&assembly), known_(std::make_unique<Known>()) {
  known_->bodies.resize(assembly.components.size());
  executor.for_each_heavy(known_->bodies.size(), [&](std::size_t c) {
    known_->bodies[c] = std::make_unique<const audit::SolidBody>(assembly.components[c]);
  });
}

PathAuditor::~PathAuditor() = default;
PathAuditor::PathAuditor(PathAuditor&&) noexcept = default;
PathAuditor& PathAuditor::operator=(PathAuditor&&) noexcept = default;

AuditReport PathAuditor::audit(const Path& path, const AuditOptions& options) const {
  const auto start = std::chrono::steady_clock::now();
  AuditReport report;
  report.tolerance = path.tolerance;
  report.slack = slack_of(*assembly_, path);
  report.violations = audit::check_declarations(*assembly_, path);

  audit::DepthContext context{
      *assembly_, path, known_->bodies, {}, {}, known_->walls, report.slack, 0, options.executor, options.progress};
  const audit::InitialDepths* initial = known_->initial_depths(context, 1 / stages_of(path));
  if (initial) {
    audit::enter_initial_depths(context, *initial);
    report.complete = audit_moves(context, report);
  }

  for (const auto& body : context.bodies) report.sheets += body->solid() ? 0 : 1;
  report.pieces = context.pieces;
  for (auto& [key, entry] : context.ledger) {
    if (entry.listed()) report.pairs.push_back(entry.pair);
    if (!entry.violated) continue;
    entry.violation.message = message_of(*assembly_, entry);
    report.violations.push_back(entry.violation);
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

AuditReport audit_path(const Assembly& assembly, const Path& path, const AuditOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  AuditReport report = PathAuditor(assembly, options.executor).audit(path, options);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace dismantle
