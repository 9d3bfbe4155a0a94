// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/pair_task.h"

#include "dismantle/audit/parted_pairs.h"

#include <cstdio>
#include <limits>

namespace dismantle::audit {

namespace {

/// Error bound of depths in units of rounding of the largest coordinate in their computation.
constexpr double kRoundingUnits = 32;

double rounding_of(const PairTask& task, const SweepTimes& times, const Pose& pose_a) {
  double largest = task.sweep.a->coordinate_bound() + task.sweep.b->coordinate_bound() + max_abs(pose_a.position);
  double position = 0;
  for (const MotionSegment& segment : times.segments) position = std::max(position, max_abs(segment.start.position));
  return kRoundingUnits * std::numeric_limits<double>::epsilon() * (largest + position);
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

}  // namespace

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

std::uint32_t parted_at(const PairTask& task) {
  const PairSweep& pair = task.sweep;
  for (std::uint32_t k = 0; k < pair.motions.size(); ++k)
    if (components_apart(*pair.a, *pair.b, pair.motions[k].start, pair.resolution)) return k;
  return static_cast<std::uint32_t>(pair.motions.size());
}

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

}  // namespace dismantle::audit
