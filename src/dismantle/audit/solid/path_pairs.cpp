// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/facet_sagitta.h"
#include "dismantle/audit/solid/move_depths.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>
#include <string>

namespace dismantle::audit {

namespace {

using Key = std::pair<std::uint32_t, std::uint32_t>;

/// Part of a depth by which the path's may be above the one that the audit finds; both are bounds.
constexpr double kDepthMargin = 0.01;

/// The comparison of the pairs that the path lists with the depths in the assembled state.
class PathPairs {
 public:
  explicit PathPairs(DepthContext& context) : context_(context), tolerance_(context.path.tolerance) {}

  std::vector<AuditViolation> apply() {
    for (const PathPair& pair : context_.path.pairs) {
      const auto a = context_.assembly.find(pair.a), b = context_.assembly.find(pair.b);
      if (!a || !b || *a == *b || !listed_.insert(std::minmax(a->value, b->value)).second) continue;
      enter(pair, std::minmax(a->value, b->value));
    }
    if (context_.path.version > 1) find_unlisted();
    return std::move(found_);
  }

 private:
  double margin(double depth) const { return std::max(kDepthMargin * depth, context_.slack); }

  void enter(const PathPair& pair, const Key& key) {
    AuditPair& entry = context_.ledger[key].pair;
    entry.a = ComponentId(key.first);
    entry.b = ComponentId(key.second);
    entry.state = pair.state;
    if (pair.state == PathPairState::Free) {
      entry.allowed = std::numeric_limits<double>::infinity();
      return;
    }
    const double allowed = std::isfinite(pair.allowed_depth) ? std::max(pair.allowed_depth, 0.0) : 0;
    if (pair.state == PathPairState::Overlapping) compare(pair, key, entry);
    if (entry.initial_depth > allowed + margin(entry.initial_depth))
      report(key, "overlap by " + mm(entry.initial_depth) + " at the start, and the path allows " + mm(allowed));
    // Else the violation would be repeated in every move.
    entry.allowed = std::max({allowed, tolerance_, entry.initial_depth});
    if (pair.state == PathPairState::Overlapping) {
      entry.turns = allowed > within_tolerance(entry);
      entry.allowed = std::min(entry.allowed, lawful(key, entry, allowed));
    }
    if (entry.allowed <= 0) entry.allowed = std::numeric_limits<double>::min();
  }

  /// The most that the pair may be allowed: its depth at the start and the tolerance; and both surfaces' sagittas where
  /// they are wanted, as cylinders that turn in each other need them.
  double lawful(const Key& key, const AuditPair& entry, double wanted) const {
    const double least = within_tolerance(entry);
    return wanted <= least ? least : least + sagittas(key);
  }

  double within_tolerance(const AuditPair& entry) const {
    return entry.initial_depth + tolerance_ + margin(entry.initial_depth);
  }

  double sagittas(const Key& key) const {
    const AuditBody &a = context_.bodies[key.first]->surface(), &b = context_.bodies[key.second]->surface();
    const auto box_of = [](const AuditBody& body) {
      Aabb box;
      for (std::uint32_t v = 0; v < body.vertex_count(); ++v) box.extend(body.vertex(v) + body.center());
      return box;
    };
    const Aabb box_a = inflated(box_of(a), tolerance_), box_b = inflated(box_of(b), tolerance_);
    const auto seen = [](const Aabb& box, const AuditBody& body) {
      return Aabb{box.lower - body.center(), box.upper - body.center()};
    };
    return facet_sagitta(a, seen(box_b, a)) + facet_sagitta(b, seen(box_a, b));
  }

  void compare(const PathPair& pair, const Key& key, AuditPair& entry) {
    if (entry.initial_depth == 0 && overlaps_by(key, pair.initial_depth)) entry.initial_depth = pair.initial_depth;
    const double depth = entry.initial_depth;
    if (pair.initial_depth > depth + margin(depth))
      report(key,
             "do not overlap by " + mm(pair.initial_depth) + " at the start, as the path says, but by " + mm(depth));
    else if (pair.allowed_depth > lawful(key, entry, pair.allowed_depth))
      report(key, "are allowed " + mm(pair.allowed_depth) + ", more than their depth at the start (" + mm(depth) +
                      "), the tolerance and the sagittas of their facets");
  }

  /// True if a pair that is not deeper than the tolerance has nearly this depth.
  bool overlaps_by(const Key& key, double depth) {
    if (!(depth <= 2 * tolerance_ + context_.slack)) return false;
    DepthGoal goal;
    goal.slack = context_.slack / 4;
    goal.floor = std::max(depth - margin(depth) - goal.slack, 0.0);  // what is deeper by the slack is found
    goal.first_only = true;
    for (const bool of_b : {false, true}) {
      const DepthFindings found = search_assembled(context_, key, of_b, goal);
      context_.pieces += found.samples;
      if (found.first.depth > 0) return true;
    }
    return false;
  }

  void find_unlisted() {
    for (const auto& [key, entry] : context_.ledger)
      if (listed_.count(key) == 0 && entry.listed())
        report(key, "overlap by " + mm(entry.pair.initial_depth) + " at the start, and the path does not list them");
  }

  static std::string mm(double length) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g mm", length);
    return text;
  }

  void report(const Key& key, const std::string& what) {
    AuditViolation violation;
    violation.a = ComponentId(key.first);
    violation.b = ComponentId(key.second);
    violation.message =
        "\"" + context_.assembly[violation.a].name + "\" and \"" + context_.assembly[violation.b].name + "\" " + what;
    found_.push_back(violation);
  }

  DepthContext& context_;
  double tolerance_;
  std::set<Key> listed_;
  std::vector<AuditViolation> found_;
};

}  // namespace

std::vector<AuditViolation> apply_path_pairs(DepthContext& context) {
  return PathPairs(context).apply();
}

}  // namespace dismantle::audit
