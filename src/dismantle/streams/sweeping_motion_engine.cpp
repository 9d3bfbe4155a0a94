// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/step_towards.h"
#include "dismantle/streams/streams_backend.h"
#include "dismantle/streams/streams_motion_engine.h"

#include <algorithm>
#include <limits>

namespace dismantle {

namespace {

/// Sweeps of the whole assembly, of which one set moves.
class SweepingMotionEngine final : public MotionEngine {
 public:
  SweepingMotionEngine(const Assembly& assembly, double tolerance, std::unique_ptr<SweepEngine> engine)
      : assembly_(assembly), tolerance_(tolerance), engine_(std::move(engine)), poses_(assembly.components.size()) {}

  void grab(Span<const ComponentId> components) override {
    DISMANTLE_EXPECT(!components.empty());
    set_ = make_rigid_set(assembly_, {components.begin(), components.end()});
    DISMANTLE_EXPECT(std::all_of(components.begin(), components.end(),
                                 [&](ComponentId c) { return poses_[c.value] == poses_[components[0].value]; }));
  }

  Span<const ComponentId> moving_set() const override { return set_.components; }

  StepResult step(const Pose& target, ResponseKind response) override {
    DISMANTLE_EXPECT(!set_.components.empty());
    const Pose start = poses_[set_.components.front().value];
    StepResult result = step_towards(*engine_, set_, start, target, response, tolerance_);
    if (!(result.pose == start)) result.poses = {result.pose};
    for (const ComponentId c : set_.components) poses_[c.value] = result.pose;
    return result;
  }

  bool can_respond(ResponseKind response) const override { return response != ResponseKind::Slide; }

  void jump(Span<const Pose> poses) override {
    DISMANTLE_EXPECT(poses.size() == poses_.size());
    std::vector<RigidTransform> state;
    for (const Pose& pose : poses) state.push_back(transform_from_pose(pose));
    engine_->jump(state);
    const auto moved = [&](ComponentId c) { return !(poses[c.value] == poses_[c.value]); };
    if (std::any_of(set_.components.begin(), set_.components.end(), moved)) set_ = {};
    poses_.assign(poses.begin(), poses.end());
  }

  Span<const Pose> poses() const override { return poses_; }
  std::vector<ComponentPair> overlapping_pairs() const override { return engine_->overlapping_pairs(); }

 private:
  const Assembly& assembly_;
  double tolerance_;
  std::unique_ptr<SweepEngine> engine_;
  RigidSet set_;
  std::vector<Pose> poses_;
};

}  // namespace

std::unique_ptr<MotionEngine> make_sweeping_motion_engine(const Assembly& assembly, double tolerance,
                                                          std::unique_ptr<SweepEngine> engine) {
  return std::make_unique<SweepingMotionEngine>(assembly, tolerance, std::move(engine));
}

std::unique_ptr<MotionEngine> make_streams_motion_engine(const Assembly& assembly, const PairStates& pairs,
                                                         const CollisionOptions& options,
                                                         std::unique_ptr<StreamsBackend> backend) {
  return make_sweeping_motion_engine(assembly, pairs.tolerance,
                                     make_streams_engine(assembly, pairs, options, std::move(backend)));
}

std::unique_ptr<MotionEngine> make_streams_motion_engine(const Assembly& assembly, const PairStates& pairs,
                                                         const CollisionOptions& options) {
  return make_streams_motion_engine(assembly, pairs, options, make_host_streams_backend(assembly, options));
}

}  // namespace dismantle
