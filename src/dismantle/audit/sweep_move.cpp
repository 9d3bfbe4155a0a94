// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/sweep_move.h"

#include "dismantle/audit/motion_span.h"
#include "dismantle/audit/parted_pairs.h"
#include "dismantle/audit/sweep_triangles.h"
#include "dismantle/audit/sweep_vertices.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <numeric>

namespace dismantle::audit {

namespace {

/// Depths are right to this many units of rounding of the largest coordinate on the way to them.
constexpr double kRoundingUnits = 32;

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

/// One pair in one move, and what was found about it.
struct PairTask {
  std::uint32_t a = 0, b = 0;  // components; b moves
  PairSweep sweep;
  std::vector<std::uint32_t> spans;  // indices of the span trees of b in which it comes near a
  Breach triangles, vertices;
  double deepest = 0;
  std::vector<CrossingVertex> crossing[2];
  bool parted = false;

  std::uint32_t low() const { return std::min(a, b); }
  std::uint32_t high() const { return std::max(a, b); }
};

/// The poses and screws of a sweep.
struct SweepTimes {
  std::size_t move = AuditViolation::kAssembledState;
  std::vector<MotionSegment> segments;
};

double rounding_of(const PairTask& task, const SweepTimes& times, const Pose& pose_a) {
  double largest = task.sweep.a->coordinate_bound() + task.sweep.b->coordinate_bound() + max_abs(pose_a.position);
  double position = 0;
  for (const MotionSegment& segment : times.segments) position = std::max(position, max_abs(segment.start.position));
  return kRoundingUnits * std::numeric_limits<double>::epsilon() * (largest + position);
}

/// The sweep of b against a.
PairTask make_task(const SweepContext& context, const SweepTimes& times, std::uint32_t a, std::uint32_t b,
                   const Pose& pose_a) {
  PairTask task;
  task.a = a;
  task.b = b;
  task.sweep.a = context.bodies[a].get();
  task.sweep.b = context.bodies[b].get();
  task.sweep.allowed = context.ledger.find(task.low(), task.high()).allowed;
  task.sweep.resolution = context.resolution;
  task.sweep.rounding = rounding_of(task, times, pose_a);
  const RigidTransform world_from_a = task.sweep.a->world_from_body(pose_a);
  for (const MotionSegment& segment : times.segments)
    task.sweep.motions.push_back(
        relative_motion(world_from_a, task.sweep.b->world_from_body(segment.start), segment.screw));
  return task;
}

/// Vertices of one component against the other: of the moving one (side 1), or of the one that stands (side 0).
VertexSweep vertex_sweep(const PairTask& task, int side) {
  const PairSweep& pair = task.sweep;
  VertexSweep sweep;
  sweep.solid = side == 0 ? pair.b : pair.a;
  sweep.points = side == 0 ? pair.a : pair.b;
  sweep.limit = 2 * pair.allowed;
  sweep.resolution = pair.resolution;
  sweep.rounding = pair.rounding;
  sweep.first_active = pair.first_active;
  sweep.end = static_cast<std::uint32_t>(pair.motions.size());
  if (task.triangles.depth > 0) sweep.end = task.triangles.segment + 1;
  sweep.motions = pair.motions;
  if (side == 0) std::transform(sweep.motions.begin(), sweep.motions.end(), sweep.motions.begin(), reversed_roles);
  return sweep;
}

/// Which of the record's two lists of vertices a side of a task is.
int record_side(const PairTask& task, int side) {
  return task.a < task.b ? side : 1 - side;
}

/// From where on an embedded pair is apart and so ordinary; the number of segments where it never is.
std::uint32_t parted_at(const PairTask& task) {
  const PairSweep& pair = task.sweep;
  for (std::uint32_t k = 0; k < pair.motions.size(); ++k)
    if (components_apart(*pair.a, *pair.b, pair.motions[k].start, pair.resolution)) return k;
  return static_cast<std::uint32_t>(pair.motions.size());
}

AuditViolation make_violation(const SweepContext& context, const SweepTimes& times, const PairTask& task,
                              AuditViolationKind kind, const Breach& breach) {
  const MotionSegment& segment = times.segments[breach.segment];
  AuditViolation violation;
  violation.move = times.move;
  violation.frame = segment.frame;
  violation.time = segment.time + breach.s * segment.duration;
  violation.a = ComponentId(task.low());
  violation.b = ComponentId(task.high());
  violation.depth = breach.depth;
  const bool triangles = kind == AuditViolationKind::TrianglesIntersect;
  violation.allowed = triangles ? task.sweep.allowed : 2 * task.sweep.allowed;
  const bool parted = context.ledger.find(task.low(), task.high()).parted;
  violation.kind = parted ? AuditViolationKind::EmbeddedMetAgain : kind;

  char where[96] = "in the assembled state";
  if (times.move != AuditViolation::kAssembledState)
    std::snprintf(where, sizeof where, "at %.6g s of move %zu (after frame %zu)", violation.time, times.move + 1,
                  violation.frame);
  char depths[96];
  std::snprintf(depths, sizeof depths, "%.6g mm (allowed: %.6g mm)", violation.depth, violation.allowed);
  const auto& components = context.assembly.components;
  violation.message = "\"" + components[task.low()].name + "\" and \"" + components[task.high()].name + "\" " +
                      (triangles ? "intersect" : "have a vertex inside the other") + " by " + depths + ", first " +
                      where + (parted ? ", after they had been apart" : "");
  return violation;
}

/// Takes what a task found into the ledger and the outcome.
void conclude(SweepContext& context, const SweepTimes& times, const PairTask& task, SweepOutcome& outcome) {
  if (task.deepest > 0) {
    PairRecord& record = context.ledger.get(task.low(), task.high());
    record.deepest = std::max(record.deepest, task.deepest);
  }
  if (task.triangles.depth > 0)
    outcome.violations.push_back(
        make_violation(context, times, task, AuditViolationKind::TrianglesIntersect, task.triangles));
  if (task.vertices.depth > 0)
    outcome.violations.push_back(make_violation(context, times, task, AuditViolationKind::VertexInside, task.vertices));
}

void sort_by_pair(std::vector<PairTask>& tasks) {
  std::sort(tasks.begin(), tasks.end(), [](const PairTask& p, const PairTask& q) {
    return p.low() != q.low() ? p.low() < q.low() : p.high() < q.high();
  });
}

/// Looks at one pair in the assembled state.
std::size_t look_at_assembled_pair(const SweepContext& context, const SweepTimes& times, PairTask& task,
                                   std::vector<std::uint32_t> (&inside)[2]) {
  if (context.ledger.find(task.low(), task.high()).embedded) {
    task.parted = parted_at(task) == 0;
    return 0;
  }
  const auto spans = motion_spans(times.segments, 0, 1, *task.sweep.b);
  const TriangleFindings found = sweep_triangles(task.sweep, spans);
  task.triangles = found.breach;
  task.deepest = found.deepest;
  std::size_t samples = found.samples;
  for (int side = 0; side < 2; ++side) {
    const VertexSweep sweep = vertex_sweep(task, side);
    if (!sweep.solid->closed()) continue;
    InsideVertices vertices = find_inside_vertices(sweep, 0);
    task.vertices.add(vertices.breach);
    inside[side] = std::move(vertices.vertices);
    samples += vertices.samples;
  }
  return samples;
}

/// Pairs whose boxes touch in the assembled state, and all that are declared embedded.
std::vector<PairTask> assembled_tasks(const SweepContext& context, const SweepTimes& times) {
  const auto& components = context.assembly.components;
  std::vector<Aabb> boxes;
  for (const Component& component : components) boxes.push_back(assembled_bounds(component));
  std::vector<std::uint32_t> order(components.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t i, std::uint32_t j) { return boxes[i].lower.x < boxes[j].lower.x; });

  std::vector<PairTask> tasks;
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < order.size() && boxes[order[j]].lower.x <= boxes[order[i]].upper.x; ++j) {
      if (!overlaps(boxes[order[i]], boxes[order[j]])) continue;
      const auto [low, high] = std::minmax(order[i], order[j]);
      tasks.push_back(make_task(context, times, low, high, Pose{}));
    }
  }
  for (const auto& [pair, record] : context.ledger.records())
    if (record.embedded && !overlaps(boxes[pair.first], boxes[pair.second]))
      tasks.push_back(make_task(context, times, pair.first, pair.second, Pose{}));
  sort_by_pair(tasks);
  return tasks;
}

/// The screws of one move and the span trees of what moves in it.
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
  /// Every span tree of the moving component `b`, one after another in time.
  void make_spans(std::uint32_t b) {
    const auto count = static_cast<std::uint32_t>(times_.segments.size());
    for (std::uint32_t first = 0; first < count; first += kSpanSegments)
      spans_[b].push_back(
          motion_spans(times_.segments, first, std::min(kSpanSegments, count - first), *context_.bodies[b]));
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
    const bool go_on = run_batches(context_, tasks_.size(), 64, from, to, [&](std::size_t i) {
      PairTask& task = tasks_[i];
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
    return go_on;
  }

  /// Rule 1 for all pairs, a span tree at a time.
  bool sweep_pairs(double from, double to) {
    std::vector<std::pair<std::size_t, std::uint32_t>> pieces;
    for (std::size_t t = 0; t < tasks_.size(); ++t) {
      for (const std::uint32_t i : tasks_[t].spans) {
        const MotionSpan& root = spans_[tasks_[t].b][i].front();
        if (root.first + root.count > tasks_[t].sweep.first_active) pieces.emplace_back(t, i);
      }
    }
    std::vector<TriangleFindings> found(pieces.size());
    const bool go_on = run_batches(context_, pieces.size(), 64, from, to, [&](std::size_t i) {
      const PairTask& task = tasks_[pieces[i].first];
      found[i] = sweep_triangles(task.sweep, spans_[task.b][pieces[i].second]);
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
    return go_on;
  }

  /// A vertex that may be inside, or become so.
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

  /// Rule 2 for all vertices that the triangles do not rule out.
  bool follow_vertices(double from, double to) {
    std::vector<VertexItem> items;
    std::vector<VertexSweep> sweeps;
    for (std::size_t t = 0; t < tasks_.size(); ++t) {
      for (int side = 0; side < 2; ++side) {
        std::vector<CrossingVertex>& crossing = tasks_[t].crossing[side];
        std::sort(crossing.begin(), crossing.end(), [](const CrossingVertex& p, const CrossingVertex& q) {
          return p.vertex != q.vertex ? p.vertex < q.vertex : p.first_segment < q.first_segment;
        });
        const std::size_t before = items.size();
        list_vertices(t, side, items);
        if (items.size() == before) continue;
        for (std::size_t i = before; i < items.size(); ++i) items[i].sweep = sweeps.size();
        sweeps.push_back(vertex_sweep(tasks_[t], side));
      }
    }
    std::vector<VertexFindings> found(items.size());
    const bool go_on = run_batches(context_, items.size(), 4096, from, to, [&](std::size_t i) {
      const VertexItem& item = items[i];
      const Span<const CrossingVertex> crossing(tasks_[item.task].crossing[item.side]);
      found[i] = sweep_vertex(sweeps[item.sweep], item.vertex, item.tracked, crossing.subspan(item.first, item.count));
    });
    take_vertices(items, found);
    look_inside_again();
    return go_on;
  }

  /// Where the triangles broke the rule, nothing was followed to the end: who is inside whom must be found anew.
  void look_inside_again() {
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
  std::vector<PairTask> tasks_;
  SweepOutcome outcome_;
};

}  // namespace

SweepOutcome sweep_assembled_state(SweepContext& context, double progress_from, double progress_to) {
  SweepTimes times;
  times.segments = {MotionSegment{}};
  std::vector<PairTask> tasks = assembled_tasks(context, times);
  struct Inside {
    std::vector<std::uint32_t> of[2];
  };
  std::vector<Inside> inside(tasks.size());
  std::vector<std::size_t> samples(tasks.size(), 0);

  SweepOutcome outcome;
  outcome.cancelled = !run_batches(context, tasks.size(), 64, progress_from, progress_to, [&](std::size_t i) {
    samples[i] = look_at_assembled_pair(context, times, tasks[i], inside[i].of);
  });
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const PairTask& task = tasks[i];
    outcome.samples += samples[i];
    if (task.parted || !inside[i].of[0].empty() || !inside[i].of[1].empty()) {
      PairRecord& record = context.ledger.get(task.low(), task.high());
      if (task.parted) record.embedded = false;
      record.parted = task.parted;
      for (int side = 0; side < 2; ++side) record.inside[record_side(task, side)] = std::move(inside[i].of[side]);
    }
    conclude(context, times, task, outcome);
  }
  return outcome;
}

SweepOutcome sweep_move(SweepContext& context, Span<const Pose> poses, std::size_t index, double progress_from,
                        double progress_to) {
  return MoveSweep(context, poses, index).run(progress_from, progress_to);
}

}  // namespace dismantle::audit
