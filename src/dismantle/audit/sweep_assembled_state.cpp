// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/pair_task.h"
#include "dismantle/audit/sweep_move.h"

#include <numeric>

namespace dismantle::audit {

namespace {

/// Checks one pair in the assembled state. @return the number of samples
std::size_t sweep_assembled_pair(const SweepContext& context, const SweepTimes& times, PairTask& task,
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

/// The pairs whose boxes overlap in the assembled state, and all that are declared embedded.
std::vector<PairTask> assembled_tasks(const SweepContext& context, const SweepTimes& times) {
  const auto& components = context.assembly.components;
  std::vector<Aabb> boxes;
  boxes.reserve(components.size());
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
    samples[i] = sweep_assembled_pair(context, times, tasks[i], inside[i].of);
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

}  // namespace dismantle::audit
