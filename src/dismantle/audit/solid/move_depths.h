// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/path.h"
#include "dismantle/audit/audit_report.h"
#include "dismantle/audit/solid/depth_search.h"
#include "dismantle/audit/solid/surface_crossing.h"
#include "dismantle/core/progress.h"
#include "dismantle/core/span.h"
#include "dismantle/exec/executor.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace dismantle::audit {

/// A pair that has an allowance of its own, or violates a rule.
struct LedgerEntry {
  AuditPair pair;            ///< For the report, if it has an allowance of its own.
  bool violated = false;     ///< It violates a rule.
  AuditViolation violation;  ///< The first violation, where there is one.
  /// True if it has an allowance of its own.
  bool listed() const { return pair.allowed > 0; }
  /// True if it still has an allowance of its own.
  bool joined() const { return listed() && !pair.parted; }
};

/// The pairs of a path, by (a, b) with a < b.
using DepthLedger = std::map<std::pair<std::uint32_t, std::uint32_t>, LedgerEntry>;

/// A pair that overlaps in the assembled state.
struct InitialDepth {
  std::pair<std::uint32_t, std::uint32_t> pair;  ///< a < b.
  double depth = 0;                              ///< An upper bound [mm].
};

/// The depths in the assembled state of all pairs but the free ones: they depend on the assembly, the free pairs, the
/// tolerance and the slack alone.
struct InitialDepths {
  std::vector<InitialDepth> overlapping;  ///< Those deeper than the tolerance, by pair.
  std::size_t pieces = 0;                 ///< AuditReport::pieces.
};

/// The data that all searches of an audit of depths share.
struct DepthContext {
  ///@{ The arguments of the audit.
  const Assembly& assembly;
  const Path& path;
  ///@}
  const std::vector<std::unique_ptr<const SolidBody>>& bodies;  ///< Of each component.
  DepthLedger ledger;                                           ///< Pairs with allowances of their own, or violations.
  /// Points of the first component followed in the frame of the second.
  std::map<std::pair<std::uint32_t, std::uint32_t>, FollowedSide> followed;
  KnownWalls& walls;       ///< Of the bodies.
  double slack = 0;        ///< AuditReport::slack [mm].
  std::size_t pieces = 0;  ///< AuditReport::pieces.
  ///@{ Of AuditOptions.
  const Executor& executor;
  const ProgressCallback& progress;
  ///@}

  /// Runs work(i) for i in [0, count) in batches, with a progress report from `from` to `to` after each; false where it
  /// was cancelled.
  template <class Work>
  bool run(std::size_t count, double from, double to, const Work& work) const {
    constexpr std::size_t kBatch = 64;
    for (std::size_t first = 0; first < count; first += kBatch) {
      const double done = static_cast<double>(first) / static_cast<double>(count);
      if (!report_progress(progress, "audit", from + done * (to - from))) return false;
      executor.for_each_heavy(count - first < kBatch ? count - first : kBatch, [&](std::size_t i) { work(first + i); });
    }
    return report_progress(progress, "audit", to);
  }
};

/// The motion of component b relative to a, which is stationary at `pose_a`, through the segments of a move.
DepthPair make_depth_pair(const DepthContext& context, std::pair<std::uint32_t, std::uint32_t> a_and_b,
                          const Pose& pose_a, const std::vector<MotionSegment>& segments);

/// The search of one side of a pair in the assembled state.
DepthFindings search_assembled(const DepthContext& context, std::pair<std::uint32_t, std::uint32_t> a_and_b, bool of_b,
                               const DepthGoal& goal);

/// The pairs that the path lists as free, in order.
std::vector<std::pair<std::uint32_t, std::uint32_t>> free_pairs(const Assembly& assembly, const Path& path);

/// Finds the depths in the assembled state of all pairs but `free`, which are in order; nothing where it was cancelled.
std::optional<InitialDepths> find_initial_depths(const DepthContext& context,
                                                 Span<const std::pair<std::uint32_t, std::uint32_t>> free,
                                                 double progress_from, double progress_to);

/// Enters the pairs that overlap in the ledger, with their depth plus the tolerance for an allowance.
void enter_initial_depths(DepthContext& context, const InitialDepths& depths);

/// Enters the allowances of the pairs that the path lists in the ledger, and compares them with the depths found.
/// @return where the path claims or allows more than these justify, or leaves out a pair that overlaps
std::vector<AuditViolation> apply_path_pairs(DepthContext& context);

/// Checks all pairs of a moving and a stationary component in move `index`; false where it was cancelled.
/// @param poses of all components before it @pre can_follow(the move)
bool check_move_depths(DepthContext& context, Span<const Pose> poses, std::size_t index, double progress_from,
                       double progress_to);

}  // namespace dismantle::audit
