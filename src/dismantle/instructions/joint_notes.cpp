// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/joint_notes.h"

#include "dismantle/joints/find_joints.h"

namespace dismantle {

namespace {

/// A removal as a straight step of a plan.
PlanStep step_of(const RemovalMove& removal, const Leg& leg) {
  PlanStep step;
  step.components = removal.components;
  const Vec3 towards = leg.length < 0 ? -leg.direction : leg.direction;
  step.exit = inverse(transform_from_pose(removal.poses.front())).rotation * towards;
  return step;
}

/// The moving set of a removal and the components that are still in their assembled poses relative to it.
ComponentSet present_at(const WorkStep& step, const RemovalMove& removal) {
  ComponentSet present(step.before.size(), surroundings(step, removal));
  for (const ComponentId c : removal.components) present.insert(c);
  return present;
}

}  // namespace

JointNotes::JointNotes(const Assembly& assembly, const std::vector<std::optional<Fastener>>& fasteners,
                       const Executor& executor)
    : joints_(find_joints(assembly, fasteners, executor)),
      groups_(assembly.components.size()),
      relations_(joints_, groups_, assembly.components.size()) {}

ComponentId JointNotes::turned_in(const RemovalMove& removal) const {
  if (removal.components.size() == 1) return removal.components.front();
  return relations_.fastener_of(removal.components);
}

std::optional<Unscrewing> JointNotes::unscrewing(const WorkStep& step, const RemovalMove& removal,
                                                 const Leg& leg) const {
  if (leg.angle > 0) return std::nullopt;
  return relations_.unscrewing(step_of(removal, leg), present_at(step, removal));
}

std::vector<ComponentId> JointNotes::still_held_by(const WorkStep& step, const RemovalMove& removal,
                                                   const Leg& leg) const {
  return relations_.torn_by(step_of(removal, leg), present_at(step, removal));
}

}  // namespace dismantle
