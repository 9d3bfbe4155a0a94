// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/rigid_groups.h"
#include "dismantle/joints/joint.h"
#include "dismantle/planner/component_set.h"
#include "dismantle/planner/plan.h"

#include <optional>
#include <vector>

namespace dismantle {

/// The order that joints ask for, whatever collides: fasteners are unscrewed along their axes before what they hold
/// moves. May be called by many threads at the same time.
class JointRelations {
 public:
  /// @param joints, groups must outlive this. Joints of a fastener that moves with others as a rigid group are ignored.
  /// @param count of components
  JointRelations(const std::vector<Joint>& joints, const RigidGroups& groups, std::size_t count);

  /// True if there is no joint to respect.
  bool empty() const { return relevant_.empty(); }
  /// True for the screws and nuts of joints.
  bool is_fastener(ComponentId c) const { return !fastened_by_[c.value].empty(); }

  /// The screw or nut of a set that consists of one and of some of its washers and inserts, or of none; invalid for
  /// other sets.
  ComponentId fastener_of(Span<const ComponentId> components) const;
  /// The washers that come off with a screw, or with a nut, that moves along a unit direction.
  std::vector<ComponentId> washers_with(ComponentId fastener, const Vec3& direction) const;

  /// A component that has to go before `c` moves by itself along a unit direction: the fastener that holds it; for a
  /// fastener that would leave its thread across the axis, what it is screwed into.
  std::optional<ComponentId> blocker(ComponentId c, const Vec3& direction, const ComponentSet& present) const;
  /// The components that move along with `c` in a body: the rest of its joints.
  std::vector<ComponentId> tied_to(ComponentId c, const ComponentSet& present) const;

  /// What a motion of `components` out of `present` tears apart: fasteners that hold some of these and stay or hold
  /// others that stay; what a fastener is screwed into that does not leave along its axis. Ascending; usually empty.
  std::vector<ComponentId> torn_by(const PlanStep& step, const ComponentSet& present) const;
  /// How a fastener that leaves along its axis, alone or with its washers, is unscrewed; nothing if it is in no thread
  /// any more.
  std::optional<Unscrewing> unscrewing(const PlanStep& step, const ComponentSet& present) const;

  /// Components that a person would remove next, after a step, the first one first: the rest of the stack that it
  /// began; equal fasteners that hold the same part; what is held no more.
  /// @param kinds first_of_shape() @param present without the components of the step
  std::vector<ComponentId> next_after(const PlanStep& step, const std::vector<ComponentId>& kinds,
                                      const ComponentSet& present) const;
  /// The axes of the joints of a fastener along which it may leave, unit.
  std::vector<Vec3> exits_of(ComponentId c) const;

 private:
  using Indices = std::vector<std::size_t>;
  /// The remaining parts of the stacks that a step has begun to take off, in the order of removal.
  /// @param present without the components of the step
  std::vector<ComponentId> rest_of_stack(const PlanStep& step, const ComponentSet& present) const;
  /// The fastener of a joint that has to go before what it holds; invalid if it is gone.
  ComponentId holder(const Joint& joint, const ComponentSet& present) const;
  bool is_closed(const Joint& joint, const ComponentSet& present) const;
  bool leaves_along(const Joint& joint, ComponentId fastener, const Vec3& direction) const;
  /// The joints of whose stacks a step moves a part.
  Indices stacks_of(const PlanStep& step) const;
  bool is_held(ComponentId c, const ComponentSet& present) const;
  void add_fasteners_beside(const Joint& joint, ComponentId gone, const std::vector<ComponentId>& kinds,
                            const ComponentSet& present, std::vector<ComponentId>& next) const;

  const std::vector<Joint>& joints_;
  Indices relevant_;                  // of joints
  std::vector<Indices> fastened_by_;  // of each component: joints of which it is the screw or a nut
  std::vector<Indices> held_by_;      // of each component: joints that hold it
  std::vector<Indices> washer_of_;    // of each component: joints of which it is a washer
};

}  // namespace dismantle
