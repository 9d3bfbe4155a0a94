// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/step_towards.h"

#include "dismantle/math/screw.h"
#include "dismantle/streams/streams_motion_engine.h"

namespace dismantle {

namespace {

/// Times that a motion up to the contact is shortened if its own sweep is not free: first up to the contact of that
/// sweep, then to half of it.
constexpr int kMaxTouchRetries = 6;
constexpr int kHalvedRetries = 3;

/// The sweeps of one step; adds up their cost.
class Stepper {
 public:
  Stepper(SweepEngine& engine, const RigidSet& set, StepResult& result)
      : engine_(engine),
        set_(set),
        result_(result),
        start_(engine.state().begin(), engine.state().end()),
        next_(start_) {}

  SweepResult sweep(const Pose& pose, double deviation) {
    const RigidTransform transform = transform_from_pose(pose);
    for (const ComponentId c : set_.components) next_[c.value] = transform;
    SweepResult swept = engine_.sweep(next_, deviation);
    ++result_.sweeps;
    add_cost(swept);
    return swept;
  }

  void commit(const Pose& pose) {
    engine_.commit();
    result_.pose = pose;
  }

  /// Puts the set back where the step began.
  void return_to(const Pose& start) {
    engine_.jump(start_);
    result_.pose = start;
  }

 private:
  void add_cost(const SweepResult& swept) {
    StepCost& cost = result_.cost;
    cost.ms += swept.timings.overall;
    cost.tests += swept.sizes.elementary_tests;
    cost.replays += swept.sizes.replays;
    cost.pairs = swept.sizes.front;
    cost.triangle_pairs = swept.sizes.triangle_pairs;
    cost.overlapping_pairs = swept.sizes.intersection_pairs;
    const double stages[] = {swept.timings.vertices, swept.timings.refit, swept.timings.front,
                             swept.timings.intersection};
    for (std::size_t k = 0; k < cost.stages.size(); ++k) cost.stages[k].ms += stages[k];
  }

  SweepEngine& engine_;
  const RigidSet& set_;
  StepResult& result_;
  const std::vector<RigidTransform> start_;
  std::vector<RigidTransform> next_;
};

}  // namespace

RigidSet make_rigid_set(const Assembly& assembly, std::vector<ComponentId> components) {
  RigidSet set;
  Aabb box;
  for (const ComponentId c : components) box.extend(assembled_bounds(assembly[c]));
  set.components = std::move(components);
  if (box.empty()) return set;
  set.center = box.center();
  set.radius = diagonal(box) / 2;
  return set;
}

StepResult step_towards(SweepEngine& engine, const RigidSet& set, const Pose& start, const Pose& target,
                        ResponseKind response, double tolerance) {
  const Pose goal{target.position, nearer_to(start.rotation, target.rotation)};
  DISMANTLE_EXPECT(response != ResponseKind::Slide);
  DISMANTLE_EXPECT(tolerance > 0);
  StepResult result;
  result.pose = start;
  result.cost.stages = {{kVerticesStage}, {kRefitStage}, {kFrontStage}, {kIntersectionStage}};
  if (start == goal) {
    result.reached = true;
    return result;
  }

  const Screw screw = screw_between(start, goal);
  const double rho = screw_radius(screw, transform_from_pose(start) * set.center, set.radius);
  const double travel = screw_path_length(screw, rho);
  const double deviation = kArcShare * tolerance;
  const int cuts = chord_count(screw_chord_deviation(screw, rho), deviation);

  Stepper stepper(engine, set, result);
  for (int k = 0; k < cuts; ++k) {
    const Pose next = pose_between(start, goal, (k + 1.0) / cuts);
    SweepResult swept = stepper.sweep(next, deviation);
    if (swept.free) {
      stepper.commit(next);
      continue;
    }
    result.blocking_pairs = std::move(swept.blocking_pairs);
    if (response == ResponseKind::Stop) {
      if (k > 0) stepper.return_to(start);
      return result;
    }
    const double backoff = kBackoffShare * tolerance / (travel / cuts);
    double share = swept.toi - backoff;
    for (int retry = 0; retry < kMaxTouchRetries && share > backoff; ++retry) {
      const Pose touching = pose_between(start, goal, (k + share) / cuts);
      const SweepResult shorter = stepper.sweep(touching, deviation);
      if (shorter.free) {
        stepper.commit(touching);
        break;
      }
      share *= retry < kMaxTouchRetries - kHalvedRetries ? shorter.toi * (1 - kBackoffShare) : 0.5;
    }
    return result;
  }
  result.reached = true;
  return result;
}

}  // namespace dismantle
