// SPDX-License-Identifier: Apache-2.0
#include "bench/baselines/obb_discrete_engine.h"

#include "bench/baselines/obb_overlap.h"
#include "dismantle/bvh/obb_tree.h"
#include "dismantle/narrowphase/intersect_triangle_triangle.h"
#include "dismantle/streams/stage_clock.h"

#include <algorithm>

namespace dismantle {

namespace {

/// A component with its tree of boxes.
struct BoxedComponent {
  TriangleMesh mesh;  // assembled
  ObbTree tree;
};

/// A pair of nodes of two trees.
struct BoxPair {
  std::uint32_t a, b;
};

Triangle moved_triangle(const BoxedComponent& component, std::uint32_t face, const RigidTransform& transform) {
  Triangle t = component.mesh.triangle(face);
  for (int k = 0; k < 3; ++k) t[k] = transform * t[k];
  return t;
}

class ObbDiscreteEngine final : public MotionEngine {
 public:
  ObbDiscreteEngine(const Assembly& assembly, const PairStates& pairs, ObbDetail detail)
      : pairs_(pairs), detail_(detail), poses_(assembly.components.size()), moves_(poses_.size(), false) {
    for (const Component& c : assembly.components) {
      TriangleMesh mesh = assembled_mesh(c);
      ObbTree tree = obb_tree_build(mesh.vertices, mesh.faces, Executor());
      components_.push_back({std::move(mesh), std::move(tree)});
    }
  }

  void grab(Span<const ComponentId> components) override {
    moving_set_.assign(components.begin(), components.end());
    moves_.assign(moves_.size(), false);
    for (const ComponentId c : moving_set_) moves_[c.value] = true;
  }

  Span<const ComponentId> moving_set() const override { return moving_set_; }
  StepResult step(const Pose& target, ResponseKind) override;
  bool can_respond(ResponseKind response) const override { return response == ResponseKind::Stop; }
  void jump(Span<const Pose> poses) override {
    const auto moved = [&](ComponentId c) { return !(poses[c.value] == poses_[c.value]); };
    if (std::any_of(moving_set_.begin(), moving_set_.end(), moved)) grab({});
    poses_.assign(poses.begin(), poses.end());
  }
  Span<const Pose> poses() const override { return poses_; }
  std::vector<ComponentPair> overlapping_pairs() const override { return {}; }

 private:
  std::vector<BlockingPair> first_contact(const Pose& target) const;
  std::vector<BlockingPair> first_contact(ComponentId moving, const Pose& target, ComponentId fixed) const;

  PairStates pairs_;
  ObbDetail detail_;
  std::vector<BoxedComponent> components_;
  std::vector<Pose> poses_;
  std::vector<bool> moves_;
  std::vector<ComponentId> moving_set_;
};

StepResult ObbDiscreteEngine::step(const Pose& target, [[maybe_unused]] ResponseKind response) {
  DISMANTLE_EXPECT(!moving_set_.empty());
  DISMANTLE_EXPECT(can_respond(response));
  StageClock clock;
  StepResult result;
  result.blocking_pairs = first_contact(target);
  result.reached = result.blocking_pairs.empty();
  result.sweeps = 1;
  if (result.reached) {
    if (!(poses_[moving_set_.front().value] == target)) result.poses = {target};
    for (const ComponentId c : moving_set_) poses_[c.value] = target;
  }
  result.pose = poses_[moving_set_.front().value];
  result.cost.ms = clock.total();
  return result;
}

std::vector<BlockingPair> ObbDiscreteEngine::first_contact(const Pose& target) const {
  for (const ComponentId moving : moving_set_) {
    for (std::uint32_t c = 0; c < poses_.size(); ++c) {
      const ComponentId fixed(c);
      if (moves_[c] || pairs_.find(moving, fixed) != nullptr) continue;
      std::vector<BlockingPair> found = first_contact(moving, target, fixed);
      if (!found.empty()) return found;
    }
  }
  return {};
}

std::vector<BlockingPair> ObbDiscreteEngine::first_contact(ComponentId moving, const Pose& target,
                                                           ComponentId fixed) const {
  const BoxedComponent& x = components_[moving.value];
  const BoxedComponent& y = components_[fixed.value];
  if (x.tree.empty() || y.tree.empty()) return {};
  const RigidTransform world_from_x = transform_from_pose(target);
  const RigidTransform world_from_y = transform_from_pose(poses_[fixed.value]);
  RigidTransform x_from_y = inverse(world_from_x) * world_from_y;  // of the trees, about their origins
  x_from_y.translation = x_from_y * y.tree.origin - x.tree.origin;

  std::vector<BoxPair> open{{0, 0}};
  while (!open.empty()) {
    const BoxPair p = open.back();
    open.pop_back();
    const ObbNode& a = x.tree.nodes[p.a];
    const ObbNode& b = y.tree.nodes[p.b];
    if (!boxes_overlap(a.box, b.box, x_from_y)) continue;
    if (detail_ == ObbDetail::Boxes) return {{std::min(moving, fixed), std::max(moving, fixed), {}, {}, 1}};
    if (a.leaf() && b.leaf()) {
      if (!intersect_triangle_triangle(moved_triangle(x, a.child, world_from_x),
                                       moved_triangle(y, b.child, world_from_y)))
        continue;
      if (moving < fixed) return {{moving, fixed, FaceId(a.child), FaceId(b.child), 1}};
      return {{fixed, moving, FaceId(b.child), FaceId(a.child), 1}};
    }
    const bool split_a = b.leaf() || (!a.leaf() && a.size >= b.size);
    for (std::uint32_t k = 0; k < 2; ++k)
      open.push_back(split_a ? BoxPair{a.child + k, p.b} : BoxPair{p.a, b.child + k});
  }
  return {};
}

}  // namespace

std::unique_ptr<MotionEngine> make_obb_discrete_engine(const Assembly& assembly, const PairStates& pairs,
                                                       ObbDetail detail) {
  return std::make_unique<ObbDiscreteEngine>(assembly, pairs, detail);
}

}  // namespace dismantle
