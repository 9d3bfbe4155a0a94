// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/sweep_move.h"

#include "dismantle/audit/pair_task.h"

#include <algorithm>
#include <utility>

namespace dismantle::audit {

namespace {

/// The sweep of one move: its segments, span trees and tasks.
class MoveSweep {
 public:
  MoveSweep(SweepContext& context, Span<const Pose> poses, std::size_t index) : context_(context), poses_(poses) {
    const Move& move = context.path.moves[index];
    std::vector<Frame> frames = move.frames;
    for (Frame& frame : frames) frame.pose.rotation = normalized(frame.pose.rotation);
    times_ = {index, motion_segments(frames)};
    moves_.resize(context.assembly.components.size(), false);
    for (const std::string& name : move.components)
      if (const auto id = context.assembly.find(name)) moves_[id->value] = true;
  }

  SweepOutcome run(double from, double to) {
    const double quarter = (to - from) / 4;
    outcome_.cancelled = !find_tasks(from, from + quarter) || !sweep_pairs(from + quarter, from + 3 * quarter) ||
                         !follow_vertices(from + 3 * quarter, to);
    for (const PairTask& task : tasks_) conclude(context_, times_, task, outcome_);
    return std::move(outcome_);
  }

 private:
  /// Makes the span trees of the moving component `b`, in the order of time; none contains both segments of a helical
  /// run and others.
  void make_spans(std::uint32_t b) {
    const AuditBody& body = *context_.bodies[b];
    const auto cut = [&](std::uint32_t first, std::uint32_t end) {
      for (; first < end; first += kSpanSegments)
        spans_[b].push_back(motion_spans(times_.segments, first, std::min(kSpanSegments, end - first), body));
    };
    runs_[b] = helical_runs(times_.segments, body, context_.resolution);
    std::uint32_t first = 0;
    for (const SegmentRun& run : runs_[b]) {
      cut(first, run.first);
      first = run.first + run.count;
      cut(run.first, first);
    }
    cut(first, static_cast<std::uint32_t>(times_.segments.size()));
  }

  /// Makes the profiles of the helical runs in which the pair may be near.
  void make_helices(PairTask& task) const {
    for (const SegmentRun& run : runs_[task.b]) {
      const auto in_run = [&](std::uint32_t i) {
        const MotionSpan& root = spans_[task.b][i].front();
        return root.first >= run.first && root.first < run.first + run.count;
      };
      if (std::none_of(task.spans.begin(), task.spans.end(), in_run)) continue;
      if (auto helical = helical_pair(task.sweep, run)) task.helices.push_back(std::move(*helical));
    }
  }

  /// Checks rule 1 for a span tree of b.
  static TriangleFindings sweep_span(const PairTask& task, const std::vector<MotionSpan>& spans) {
    const MotionSpan& root = spans.front();
    for (const HelicalPair& helical : task.helices) {
      const SegmentRun& run = helical.motion.run;
      if (root.first >= run.first && root.first < run.first + run.count)
        return sweep_helix(task.sweep, helical, {root.first, root.count});
    }
    return sweep_triangles(task.sweep, spans);
  }

  /// The span trees in which b may come near a.
  std::vector<std::uint32_t> near_spans(std::uint32_t a, std::uint32_t b) const {
    std::vector<std::uint32_t> near;
    const AuditBody& body_a = *context_.bodies[a];
    const AuditBody& body_b = *context_.bodies[b];
    const RigidTransform a_from_world = inverse(body_a.world_from_body(poses_[a]));
    for (std::uint32_t i = 0; i < spans_[b].size(); ++i) {
      const MotionSpan& root = spans_[b][i].front();
      const Pose& middle = times_.segments[root.middle].start;
      const Vec3 center = a_from_world * (transform_from_pose(middle) * body_b.center());
      const double reach = body_b.node(0).reach + root.shift;
      const BoxNode& box = body_a.node(0);
      if (distance_to_box(box, center) <= (1 + 1e-9) * reach + context_.resolution) near.push_back(i);
    }
    return near;
  }

  bool find_tasks(double from, double to) {
    const auto count = static_cast<std::uint32_t>(moves_.size());
    spans_.resize(count);
    runs_.resize(count);
    for (std::uint32_t b = 0; b < count; ++b) {
      if (!moves_[b] || context_.bodies[b]->empty()) continue;
      make_spans(b);
      for (std::uint32_t a = 0; a < count; ++a) {
        if (moves_[a] || context_.bodies[a]->empty()) continue;
        const PairRecord& record = context_.ledger.find(std::min(a, b), std::max(a, b));
        std::vector<std::uint32_t> near = near_spans(a, b);
        if (near.empty() && !record.embedded) continue;
        tasks_.push_back(make_task(context_, times_, a, b, poses_[a]));
        tasks_.back().spans = std::move(near);
      }
    }
    sort_by_pair(tasks_);
    const bool completed = run_batches(context_, tasks_.size(), 64, from, to, [&](std::size_t i) {
      PairTask& task = tasks_[i];
      make_helices(task);
      if (!context_.ledger.find(task.low(), task.high()).embedded) return;
      task.sweep.first_active = parted_at(task);
      task.parted = task.sweep.first_active < times_.segments.size();
    });
    for (const PairTask& task : tasks_) {
      if (!task.parted) continue;
      PairRecord& record = context_.ledger.get(task.low(), task.high());
      record.embedded = false;
      record.parted = true;
    }
    return completed;
  }

  /// Checks rule 1 for all pairs, one span tree at a time; false where it was cancelled.
  bool sweep_pairs(double from, double to) {
    std::vector<std::pair<std::size_t, std::uint32_t>> pieces;
    for (std::size_t t = 0; t < tasks_.size(); ++t) {
      for (const std::uint32_t i : tasks_[t].spans) {
        const MotionSpan& root = spans_[tasks_[t].b][i].front();
        if (root.first + root.count > tasks_[t].sweep.first_active) pieces.emplace_back(t, i);
      }
    }
    std::vector<TriangleFindings> found(pieces.size());
    const bool completed = run_batches(context_, pieces.size(), 64, from, to, [&](std::size_t i) {
      const PairTask& task = tasks_[pieces[i].first];
      found[i] = sweep_span(task, spans_[task.b][pieces[i].second]);
    });
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      PairTask& task = tasks_[pieces[i].first];
      task.triangles.add(found[i].breach);
      task.deepest = std::max(task.deepest, found[i].deepest);
      outcome_.samples += found[i].samples;
      for (int side = 0; side < 2; ++side)
        task.crossing[side].insert(task.crossing[side].end(), found[i].crossing[side].begin(),
                                   found[i].crossing[side].end());
    }
    return completed;
  }

  /// A vertex that may be, or come, inside.
  struct VertexItem {
    std::size_t task = 0;
    int side = 0;
    std::uint32_t vertex = 0;
    bool tracked = false;
    std::size_t first = 0, count = 0;  // its entries in the task's crossings
    std::size_t sweep = 0;
  };

  void list_vertices(std::size_t t, int side, std::vector<VertexItem>& items) const {
    const PairTask& task = tasks_[t];
    const std::vector<CrossingVertex>& crossing = task.crossing[side];
    const PairRecord& record = context_.ledger.find(task.low(), task.high());
    const std::vector<std::uint32_t>& inside = record.inside[record_side(task, side)];
    std::size_t i = 0, j = 0;
    while (i < crossing.size() || j < inside.size()) {
      const std::uint32_t next_i = i < crossing.size() ? crossing[i].vertex : VertexId::kInvalid;
      const std::uint32_t next_j = j < inside.size() ? inside[j] : VertexId::kInvalid;
      VertexItem item{t, side, std::min(next_i, next_j), next_j <= next_i, i, 0, 0};
      while (i < crossing.size() && crossing[i].vertex == item.vertex) ++i;
      if (item.tracked) ++j;
      item.count = i - item.first;
      items.push_back(item);
    }
  }

  /// Checks rule 2 for all vertices that the triangle sweep does not exclude; false where it was cancelled.
  bool follow_vertices(double from, double to) {
    std::vector<VertexItem> items;
    std::vector<VertexSweep> sweeps;
    for (std::size_t t = 0; t < tasks_.size(); ++t) {
      for (int side = 0; side < 2; ++side) {
        std::vector<CrossingVertex>& crossing = tasks_[t].crossing[side];
        std::sort(crossing.begin(), crossing.end(), [](const CrossingVertex& p, const CrossingVertex& q) {
          return p.vertex != q.vertex ? p.vertex < q.vertex : p.segment < q.segment;
        });
        const std::size_t before = items.size();
        list_vertices(t, side, items);
        if (items.size() == before) continue;
        for (std::size_t i = before; i < items.size(); ++i) items[i].sweep = sweeps.size();
        sweeps.push_back(vertex_sweep(tasks_[t], side));
      }
    }
    std::vector<VertexFindings> found(items.size());
    const bool completed = run_batches(context_, items.size(), 4096, from, to, [&](std::size_t i) {
      const VertexItem& item = items[i];
      const Span<const CrossingVertex> crossing(tasks_[item.task].crossing[item.side]);
      found[i] = sweep_vertex(sweeps[item.sweep], item.vertex, item.tracked, crossing.subspan(item.first, item.count));
    });
    take_vertices(items, found);
    find_inside_again();
    return completed;
  }

  /// Finds the vertices inside at the end of the move for pairs with a breach of rule 1, which were not followed to the
  /// end.
  void find_inside_again() {
    std::vector<std::pair<std::size_t, int>> lost;
    for (std::size_t t = 0; t < tasks_.size(); ++t)
      for (int side = 0; side < 2 && tasks_[t].triangles.depth > 0; ++side) lost.emplace_back(t, side);
    std::vector<std::vector<std::uint32_t>> inside(lost.size());
    context_.executor.for_each_heavy(lost.size(), [&](std::size_t i) {
      const VertexSweep sweep = vertex_sweep(tasks_[lost[i].first], lost[i].second);
      if (sweep.solid->closed())
        inside[i] = find_inside_vertices(sweep, static_cast<std::uint32_t>(sweep.motions.size()) - 1).vertices;
    });
    for (std::size_t i = 0; i < lost.size(); ++i) {
      const PairTask& task = tasks_[lost[i].first];
      context_.ledger.get(task.low(), task.high()).inside[record_side(task, lost[i].second)] = std::move(inside[i]);
    }
  }

  void take_vertices(const std::vector<VertexItem>& items, const std::vector<VertexFindings>& found) {
    std::size_t last_task = tasks_.size();
    int last_side = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
      PairTask& task = tasks_[items[i].task];
      task.vertices.add(found[i].breach);
      outcome_.samples += found[i].samples;
      PairRecord& record = context_.ledger.get(task.low(), task.high());
      std::vector<std::uint32_t>& inside = record.inside[record_side(task, items[i].side)];
      if (items[i].task != last_task || items[i].side != last_side) inside.clear();
      last_task = items[i].task;
      last_side = items[i].side;
      if (found[i].tracked) inside.push_back(items[i].vertex);
    }
  }

  static double distance_to_box(const BoxNode& box, Vec3 point) {
    const Vec3 offset = point - box.center;
    return length(max(max(offset, -offset) - box.half, Vec3{}));
  }

  SweepContext& context_;
  Span<const Pose> poses_;
  SweepTimes times_;
  std::vector<bool> moves_;                                  // by component
  std::vector<std::vector<std::vector<MotionSpan>>> spans_;  // by component, by part of the move
  std::vector<std::vector<SegmentRun>> runs_;                // by component: its helical runs
  std::vector<PairTask> tasks_;
  SweepOutcome outcome_;
};

}  // namespace

SweepOutcome sweep_move(SweepContext& context, Span<const Pose> poses, std::size_t index, double progress_from,
                        double progress_to) {
  return MoveSweep(context, poses, index).run(progress_from, progress_to);
}

}  // namespace dismantle::audit
