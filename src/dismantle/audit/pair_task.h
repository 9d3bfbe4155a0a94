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

/// One pair in one move, and what was found about it.
struct PairTask {
  std::uint32_t a = 0, b = 0;  ///< Components; b moves.
  PairSweep sweep;
  std::vector<std::uint32_t> spans;         ///< Indices of the span trees of b in which it may come near a.
  std::vector<HelicalPair> helices;         ///< In these runs it is looked at from the axis.
  Breach triangles, vertices;               ///< Of rule 1 and of rule 2.
  double deepest = 0;                       ///< Of its triangles [mm].
  std::vector<CrossingVertex> crossing[2];  ///< Of a against b, of b against a.
  bool parted = false;                      ///< It was embedded and is so no more.

  std::uint32_t low() const { return std::min(a, b); }
  std::uint32_t high() const { return std::max(a, b); }
};

/// The poses and screws of a sweep.
struct SweepTimes {
  std::size_t move = AuditViolation::kAssembledState;
  std::vector<MotionSegment> segments;
};

/// The sweep of b against a, which stands at `pose_a`.
PairTask make_task(const SweepContext& context, const SweepTimes& times, std::uint32_t a, std::uint32_t b,
                   const Pose& pose_a);

/// Vertices of one component against the other: of the moving one (side 1), or of the one that stands (side 0).
VertexSweep vertex_sweep(const PairTask& task, int side);

/// Which of the two lists of vertices of the pair's record a side of a task is.
inline int record_side(const PairTask& task, int side) {
  return task.a < task.b ? side : 1 - side;
}

/// From where on an embedded pair is apart and so ordinary; the number of segments where it never is.
std::uint32_t parted_at(const PairTask& task);

/// Sorts by pair: the order of the report.
void sort_by_pair(std::vector<PairTask>& tasks);

/// Takes what a task found into the ledger and the outcome.
void conclude(SweepContext& context, const SweepTimes& times, const PairTask& task, SweepOutcome& outcome);

/// Runs work(i) for all i in batches, with progress and the chance to cancel between them.
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
