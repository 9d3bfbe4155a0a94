// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/audit_report.h"
#include "dismantle/audit/motion/motion_span.h"
#include "dismantle/audit/sweep_helix.h"
#include "dismantle/audit/sweep_move.h"
#include "dismantle/audit/sweep_triangles.h"
#include "dismantle/audit/sweep_vertices.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace dismantle::audit {

/// One pair in one move, and its findings.
struct PairTask {
  ///@{ The components; b moves.
  std::uint32_t a = 0, b = 0;
  ///@}
  PairSweep sweep;                   ///< The motion of b relative to a.
  std::vector<std::uint32_t> spans;  ///< Indices of the span trees of b in which it may come near a.
  std::vector<HelicalPair> helices;  ///< The runs that sweep_helix() checks.
  ///@{ The first breach of rule 1 and of rule 2.
  Breach triangles, vertices;
  ///@}
  double deepest = 0;                       ///< Largest depth of its triangles [mm].
  std::vector<CrossingVertex> crossing[2];  ///< Vertices of a against b, of b against a.
  bool parted = false;                      ///< It was embedded and parts in this move.

  ///@{ The components in the order of their indices.
  std::uint32_t low() const { return std::min(a, b); }
  std::uint32_t high() const { return std::max(a, b); }
  ///@}
};

/// The segments of a move.
struct SweepTimes {
  std::size_t move = AuditViolation::kAssembledState;  ///< Index of the move.
  std::vector<MotionSegment> segments;                 ///< In order.
};

/// The task of b against a, which is stationary at `pose_a`.
PairTask make_task(const SweepContext& context, const SweepTimes& times, std::uint32_t a, std::uint32_t b,
                   const Pose& pose_a);

/// The sweep of the vertices of the moving component (side 1) or the stationary one (side 0) against the other.
VertexSweep vertex_sweep(const PairTask& task, int side);

/// Index of a task's side in PairRecord::inside.
inline int record_side(const PairTask& task, int side) {
  return task.a < task.b ? side : 1 - side;
}

/// The segment at whose start an embedded pair parts; the number of segments where it does not.
std::uint32_t parted_at(const PairTask& task);

/// Sorts by pair, the order of the report.
void sort_by_pair(std::vector<PairTask>& tasks);

/// Adds the findings of a task to the ledger and the outcome.
void conclude(SweepContext& context, const SweepTimes& times, const PairTask& task, SweepOutcome& outcome);

/// Runs work(i) for i in [0, count) in batches, with a progress report from `from` to `to` after each; false where it
/// was cancelled.
template <class Work>
bool run_batches(const SweepContext& context, std::size_t count, std::size_t batch, double from, double to,
                 const Work& work) {
  for (std::size_t first = 0; first < count; first += batch) {
    const double done = static_cast<double>(first) / static_cast<double>(count);
    if (!report_progress(context.progress, "audit", from + done * (to - from))) return false;
    context.executor.for_each_heavy(std::min(batch, count - first), [&](std::size_t i) { work(first + i); });
  }
  return report_progress(context.progress, "audit", to);
}

}  // namespace dismantle::audit
