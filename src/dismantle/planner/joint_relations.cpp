// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/joint_relations.h"

#include "dismantle/math/angle.h"
#include "dismantle/math/screw.h"

#include <algorithm>
#include <cmath>

namespace dismantle {

namespace {

/// Maximum sine of the angle between a motion and the axis along which a fastener is unscrewed.
constexpr double kAlong = 0.02;

bool has(const std::vector<ComponentId>& list, ComponentId c) {
  return std::find(list.begin(), list.end(), c) != list.end();
}

bool is_insert(const Joint& joint, ComponentId c) {
  return std::any_of(joint.nut_inserts.begin(), joint.nut_inserts.end(),
                     [&](const NutInsert& ring) { return ring.insert == c; });
}

void sort_unique(std::vector<ComponentId>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// A path that turns for less than this share of a thread has left it before its end.
constexpr double kMostOfThread = 0.5;

/// How a path that turns unscrews: by its own rotation about the exit, which is anticlockwise for a right-hand
/// thread.
Unscrewing unscrewing_of_path(const PlanStep& step) {
  double angle = 0;
  Pose from;
  for (const Pose& to : step.poses) {
    const Screw screw = screw_between(from, to);
    angle += screw.angle * dot(screw.axis, step.exit);
    from = to;
  }
  Unscrewing found;
  found.turns = std::abs(angle) / kTurn;
  found.travel = std::abs(dot(from.position, step.exit));
  found.pitch = found.turns > 0 ? found.travel / found.turns : 0;
  found.left_handed = angle < 0;
  found.nominal = false;
  return found;
}

/// The fastener that holds a washer as long as it is there: nuts those of their side, the screw the others.
ComponentId holder_of_washer(const Joint& joint, ComponentId washer, const ComponentSet& present) {
  const bool by_nut = has(joint.nut_washers, washer);
  if (!by_nut) return joint.screw.valid() && present.has(joint.screw) ? joint.screw : ComponentId();
  for (const ComponentId nut : joint.nuts)
    if (present.has(nut)) return nut;
  return {};
}

}  // namespace

JointRelations::JointRelations(const std::vector<Joint>& joints, const RigidGroups& groups, std::size_t count)
    : joints_(joints), fastened_by_(count), held_by_(count), washer_of_(count) {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Joint& joint = joints[i];
    const ComponentId first = joint.screw.valid() ? joint.screw : joint.nuts.front();
    const Span<const ComponentId> group = groups.of(first);
    if (std::any_of(group.begin(), group.end(), [&](ComponentId c) { return c != first && !is_insert(joint, c); }))
      continue;
    relevant_.push_back(i);
    if (joint.screw.valid()) fastened_by_[joint.screw.value].push_back(i);
    for (const ComponentId nut : joint.nuts) fastened_by_[nut.value].push_back(i);
    for (const ComponentId c : joint.held) held_by_[c.value].push_back(i);
    for (const ComponentId c : joint.head_washers) washer_of_[c.value].push_back(i);
    for (const ComponentId c : joint.nut_washers) washer_of_[c.value].push_back(i);
  }
}

ComponentId JointRelations::holder(const Joint& joint, const ComponentSet& present) const {
  if (joint.screw.valid()) return present.has(joint.screw) ? joint.screw : ComponentId();
  return present.has(joint.nuts.front()) ? joint.nuts.front() : ComponentId();
}

bool JointRelations::is_closed(const Joint& joint, const ComponentSet& present) const {
  return holder(joint, present).valid() && present.has(joint.thread_in);
}

bool JointRelations::leaves_along(const Joint& joint, ComponentId fastener, const Vec3& direction) const {
  const bool towards_head = fastener == joint.screw && joint.has_head;
  return length(cross(joint.axis, direction)) <= kAlong && (!towards_head || dot(joint.axis, direction) > 0);
}

ComponentId JointRelations::fastener_of(Span<const ComponentId> components) const {
  ComponentId fastener;
  for (const ComponentId c : components) {
    if (!is_fastener(c)) continue;
    if (fastener.valid()) return {};
    fastener = c;
  }
  if (!fastener.valid()) return {};
  for (const ComponentId c : components) {
    const auto has_washer = [&](std::size_t i) {
      const Joint& joint = joints_[i];
      return has(joint.head_washers, c) || has(joint.nut_washers, c) || is_insert(joint, c);
    };
    const Indices& of = fastened_by_[fastener.value];
    if (c != fastener && std::none_of(of.begin(), of.end(), has_washer)) return {};
  }
  return fastener;
}

std::vector<ComponentId> JointRelations::washers_with(ComponentId fastener, const Vec3& direction) const {
  std::vector<ComponentId> washers;
  for (const std::size_t i : fastened_by_[fastener.value]) {
    const Joint& joint = joints_[i];
    if (!leaves_along(joint, fastener, direction)) continue;
    const std::vector<ComponentId>& own = fastener == joint.screw ? joint.head_washers : joint.nut_washers;
    washers.insert(washers.end(), own.begin(), own.end());
  }
  return washers;
}

std::optional<ComponentId> JointRelations::blocker(ComponentId c, const Vec3& direction,
                                                   const ComponentSet& present) const {
  for (const std::size_t i : held_by_[c.value])
    if (const ComponentId by = holder(joints_[i], present); by.valid()) return by;
  for (const std::size_t i : washer_of_[c.value])
    if (const ComponentId by = holder_of_washer(joints_[i], c, present); by.valid()) return by;
  for (const std::size_t i : fastened_by_[c.value]) {
    const Joint& joint = joints_[i];
    if (leaves_along(joint, c, direction)) continue;
    if (c != joint.screw && joint.screw.valid()) {
      if (present.has(joint.screw)) return joint.screw;
      continue;
    }
    for (const ComponentId other : joint.held)
      if (present.has(other)) return other;
    for (const ComponentId nut : joint.nuts)
      if (nut != c && present.has(nut)) return nut;
  }
  return std::nullopt;
}

std::vector<ComponentId> JointRelations::tied_to(ComponentId c, const ComponentSet& present) const {
  std::vector<ComponentId> tied;
  for (const std::vector<Indices>* of : {&held_by_, &washer_of_, &fastened_by_})
    for (const std::size_t i : (*of)[c.value]) {
      const Joint& joint = joints_[i];
      if (!holder(joint, present).valid()) continue;
      tied.insert(tied.end(), joint.held.begin(), joint.held.end());
      const std::vector<ComponentId> stack = joint.stack();
      tied.insert(tied.end(), stack.begin(), stack.end());
    }
  std::erase_if(tied, [&](ComponentId other) { return other == c || !present.has(other); });
  sort_unique(tied);
  return tied;
}

std::vector<ComponentId> JointRelations::torn_by(const PlanStep& step, const ComponentSet& present) const {
  const ComponentSet moving(present.universe(), step.components);
  const ComponentId fastener = fastener_of(step.components);
  std::vector<ComponentId> torn;
  const auto stays = [&](ComponentId c) { return present.has(c) && !moving.has(c); };
  for (const ComponentId c : step.components) {
    for (const std::size_t i : held_by_[c.value]) {
      const Joint& joint = joints_[i];
      if (!is_closed(joint, present)) continue;
      const ComponentId by = holder(joint, present);
      if (stays(by) || std::any_of(joint.held.begin(), joint.held.end(), stays)) torn.push_back(by);
    }
    for (const std::size_t i : fastened_by_[c.value]) {
      const Joint& joint = joints_[i];
      if (c != fastener || !is_closed(joint, present) || leaves_along(joint, c, step.exit)) continue;
      torn.push_back(c == joint.thread_in ? joint.screw : joint.thread_in);
    }
  }
  std::erase_if(torn, [](ComponentId c) { return !c.valid(); });
  sort_unique(torn);
  return torn;
}

std::optional<Unscrewing> JointRelations::unscrewing(const PlanStep& step, const ComponentSet& present) const {
  const ComponentId c = fastener_of(step.components);
  std::optional<Unscrewing> known, path;
  if (step.tier == PlanTier::Helical && step.components.size() == 1) path = unscrewing_of_path(step);
  if (c.valid())
    for (const std::size_t i : fastened_by_[c.value]) {
      const Joint& joint = joints_[i];
      if (known || !is_closed(joint, present) || !leaves_along(joint, c, step.exit)) continue;
      known = c == joint.screw ? joint.screw_leaves : joint.nut_leaves;
    }
  if (!path) return known;
  // Threads that are drawn into each other do not hold: the path may leave them long before a real one does.
  if (known && path->pitch > 0 && path->travel < kMostOfThread * known->travel) {
    path->travel = known->travel;
    path->turns = known->travel / path->pitch;
  }
  return path;
}

bool JointRelations::is_held(ComponentId c, const ComponentSet& present) const {
  const Indices& by = held_by_[c.value];
  return std::any_of(by.begin(), by.end(), [&](std::size_t i) { return holder(joints_[i], present).valid(); });
}

void JointRelations::add_fasteners_beside(const Joint& joint, ComponentId gone, const std::vector<ComponentId>& kinds,
                                          const ComponentSet& present, std::vector<ComponentId>& next) const {
  // What most joints hold, a case, says less than what few hold, its cover.
  std::vector<ComponentId> parts = joint.held;
  std::stable_sort(parts.begin(), parts.end(), [this](ComponentId a, ComponentId b) {
    return held_by_[a.value].size() < held_by_[b.value].size();
  });
  for (const ComponentId part : parts)
    for (const std::size_t i : held_by_[part.value])
      for (const ComponentId c : joints_[i].stack())
        if (is_fastener(c) && kinds[c.value] == kinds[gone.value]) next.push_back(c);
  // Those of the part that few hold, of any kind.
  if (!parts.empty())
    for (const std::size_t i : held_by_[parts.front().value])
      for (const ComponentId c : joints_[i].stack()) next.push_back(c);
  for (const ComponentId part : parts)
    if (!is_held(part, present)) next.push_back(part);
}

std::vector<ComponentId> JointRelations::rest_of_stack(const PlanStep& step, const ComponentSet& present) const {
  std::vector<ComponentId> rest;
  for (const std::size_t i : stacks_of(step))
    for (const ComponentId c : joints_[i].stack())
      if (present.has(c) && !has(rest, c)) rest.push_back(c);
  return rest;
}

std::vector<ComponentId> JointRelations::next_after(const PlanStep& step, const std::vector<ComponentId>& kinds,
                                                    const ComponentSet& present) const {
  std::vector<ComponentId> once = rest_of_stack(step, present), next;
  for (const std::size_t i : stacks_of(step)) {
    const Joint& joint = joints_[i];
    add_fasteners_beside(joint, joint.screw.valid() ? joint.screw : joint.nuts.front(), kinds, present, next);
  }
  for (const ComponentId c : next)
    if (present.has(c) && !has(once, c)) once.push_back(c);
  return once;
}

JointRelations::Indices JointRelations::stacks_of(const PlanStep& step) const {
  Indices found;
  for (const ComponentId c : step.components)
    for (const std::vector<Indices>* of : {&fastened_by_, &washer_of_})
      for (const std::size_t i : (*of)[c.value])
        if (std::find(found.begin(), found.end(), i) == found.end()) found.push_back(i);
  return found;
}

std::vector<Vec3> JointRelations::exits_of(ComponentId c) const {
  std::vector<Vec3> exits;
  for (const std::size_t i : fastened_by_[c.value]) {
    const Joint& joint = joints_[i];
    if (c == joint.screw || !joint.has_head) exits.push_back(joint.axis);
    if (c != joint.screw || !joint.has_head) exits.push_back(-joint.axis);
  }
  return exits;
}

}  // namespace dismantle
