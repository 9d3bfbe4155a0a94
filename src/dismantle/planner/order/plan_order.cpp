// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/order/plan_order.h"

#include "dismantle/core/contract.h"
#include "dismantle/planner/precedence_graph.h"
#include "dismantle/planner/search/exposure.h"
#include "dismantle/surface/equal_shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace dismantle {

namespace {

/// Directions within this sine are equal.
constexpr double kSameDirection = 0.02;
/// Exits that point up or down by more than this sine are made from above or from below.
constexpr double kVertical = 0.2;
/// A criterion counts as many times as much as the next one.
constexpr double kMoreImportant = 10;

constexpr std::uint32_t kNoStep = OrderedStep::kNone;

using Indices = std::vector<std::uint32_t>;

void add_unique(Indices& list, std::uint32_t index) {
  const auto at = std::lower_bound(list.begin(), list.end(), index);
  if (at == list.end() || *at != index) list.insert(at, index);
}

/// Numbers what makes steps equal.
class StepKinds {
 public:
  StepKinds(const Assembly& assembly, const std::vector<std::optional<Fastener>>& fasteners)
      : shapes_(first_of_shape(assembly)), fasteners_(fasteners) {}

  /// The kind of steps that follow one another at once.
  std::uint32_t joined(Indices kinds) {
    kinds.push_back(OrderedStep::kNone);  // unlike shapes
    return kind_of(kinds);
  }

  OrderedStep describe(const PlanStep& step) {
    OrderedStep ordered;
    ordered.direction = direction(step.exit);
    if (std::abs(step.exit.z) > kVertical) ordered.up = step.exit.z > 0 ? 1 : -1;
    Indices shapes;
    shapes.reserve(step.components.size());
    for (const ComponentId c : step.components) shapes.push_back(shapes_[c.value].value);
    std::sort(shapes.begin(), shapes.end());
    ordered.kind = kind_of(shapes);
    for (const ComponentId c : step.components) {
      if (fasteners_.empty() || !fasteners_[c.value]) continue;
      const std::string tool = tool_text(*fasteners_[c.value]);
      if (tool.empty()) continue;
      ordered.tool = tools_.try_emplace(tool, static_cast<std::uint32_t>(tools_.size() + 1)).first->second;
      break;
    }
    return ordered;
  }

 private:
  std::uint32_t kind_of(const Indices& shapes) {
    return kinds_.try_emplace(shapes, static_cast<std::uint32_t>(kinds_.size())).first->second;
  }

  std::uint32_t direction(const Vec3& exit) {
    const auto same = std::find_if(directions_.begin(), directions_.end(),
                                   [&](const Vec3& known) { return length(known - exit) < kSameDirection; });
    if (same == directions_.end()) {
      directions_.push_back(exit);
      return static_cast<std::uint32_t>(directions_.size() - 1);
    }
    return static_cast<std::uint32_t>(same - directions_.begin());
  }

  std::vector<ComponentId> shapes_;
  const std::vector<std::optional<Fastener>>& fasteners_;
  std::vector<Vec3> directions_;
  std::map<Indices, std::uint32_t> kinds_;
  std::map<std::string, std::uint32_t> tools_;
};

/// Orders the steps that take apart one body. Steps are numbered within it.
class SectionOrder {
 public:
  SectionOrder(const Plan& plan, const Indices& members, const ComponentSet& body, const PlanOrderContext& with,
               Exposure& exposure)
      : plan_(plan),
        members_(members),
        body_(body),
        with_(with),
        exposure_(exposure),
        size_(diagonal(assembled_bounds(with.planned.assembly))),
        step_of_(with.planned.size(), kNoStep) {
    for (std::uint32_t i = 0; i < members.size(); ++i)
      for (const ComponentId c : step(i).components) step_of_[c.value] = i;
  }

  /// The members in their best order; as they are, if the search was ended or the order cannot be validated.
  Indices run(StepKinds& kinds, const OrderWeights& weights) {
    std::vector<OrderedStep> steps;
    steps.reserve(members_.size());
    for (std::uint32_t i = 0; i < members_.size(); ++i) steps.push_back(kinds.describe(step(i)));
    add_joints(steps);
    add_passed(steps);
    keep_stacks_together(steps, kinds);
    if (weights.support > 0) add_supports(steps);
    if (!with_.keep_going()) return members_;
    const Indices order = best_order(steps, weights, with_.keep_going);
    if (!is_valid(order)) return members_;
    Indices ordered;
    ordered.reserve(order.size());
    for (const std::uint32_t i : order) ordered.push_back(members_[i]);
    return ordered;
  }

 private:
  const PlanStep& step(std::uint32_t i) const { return plan_.steps[members_[i]]; }

  /// A fastener comes before what it holds, and the parts of a stack one after another, where they do.
  void add_joints(std::vector<OrderedStep>& steps) const {
    for (const Joint& joint : plan_.joints) {
      Indices stack;
      for (const ComponentId c : joint.stack())
        if (step_of_[c.value] != kNoStep) add_unique(stack, step_of_[c.value]);
      for (std::size_t i = 1; i < stack.size(); ++i) add_unique(steps[stack[i]].before, stack[i - 1]);
      const ComponentId first = joint.screw.valid() ? joint.screw : joint.nuts.front();
      const std::uint32_t released = step_of_[first.value];
      if (released == kNoStep) continue;
      for (const ComponentId held : joint.held) {
        const std::uint32_t after = step_of_[held.value];
        if (after == kNoStep || after <= released) continue;
        add_unique(steps[after].before, released);
        add_unique(steps[after].held_by, released);
      }
    }
  }

  /// The parts of a stack that follow one another at once go on doing so, and equal stacks are of one kind.
  void keep_stacks_together(std::vector<OrderedStep>& steps, StepKinds& kinds) const {
    for (const Joint& joint : plan_.joints) {
      Indices stack;
      for (const ComponentId c : joint.stack())
        if (step_of_[c.value] != kNoStep) add_unique(stack, step_of_[c.value]);
      for (std::size_t i = 1; i < stack.size(); ++i)
        if (stack[i] == stack[i - 1] + 1) steps[stack[i - 1]].followed_by = stack[i];
    }
    for (std::uint32_t first = 0; first < steps.size(); ++first) {
      std::uint32_t last = first;
      while (steps[last].followed_by != kNoStep) last = steps[last].followed_by;
      if (last == first) continue;
      Indices kinds_of_each;
      for (std::uint32_t i = first; i <= last; ++i) {
        kinds_of_each.push_back(steps[i].kind);
        for (const std::uint32_t before : steps[i].before)
          if (before < first) add_unique(steps[first].before, before);
      }
      const std::uint32_t kind = kinds.joined(kinds_of_each);
      for (; first < last; ++first) steps[first].kind = kind;
      steps[last].kind = kind;
    }
  }

  /// What each step passes comes before it, and what has to be gone for it to be exposed.
  void add_passed(std::vector<OrderedStep>& steps) {
    const std::vector<std::vector<ComponentId>> passed = passed_by_each();
    ComponentSet gone(with_.planned.size()), left = body_;
    std::uint32_t last_resort = kNoStep;
    for (std::uint32_t i = 0; i < steps.size() && with_.keep_going(); ++i) {
      const auto opened_by = opening(i, left, gone);
      for (const ComponentId c : passed[i]) add_unique(steps[i].before, step_of_[c.value]);
      if (opened_by) {
        for (const ComponentId c : *opened_by) add_unique(steps[i].before, step_of_[c.value]);
      } else if (steps[i].held_by.empty()) {  // after all others; those before the previous one follow from that
        for (std::uint32_t j = last_resort == kNoStep ? 0 : last_resort; j < i; ++j) add_unique(steps[i].before, j);
        last_resort = i;
      }
      for (const ComponentId c : step(i).components) gone.insert(c);
      left.erase(step(i).components);
    }
  }

  /// The components that were removed before each step and lie in its way.
  std::vector<std::vector<ComponentId>> passed_by_each() {
    std::vector<DirectionId> directions;
    for (std::uint32_t i = 0; i < members_.size(); ++i) directions.push_back(with_.table.add_direction(step(i).exit));
    std::vector<std::vector<ComponentId>> passed(members_.size());
    with_.executor.for_each_heavy(members_.size(), [&](std::size_t k) {
      const auto i = static_cast<std::uint32_t>(k);
      ComponentSet gone(with_.planned.size());
      for (std::uint32_t j = 0; j < i; ++j)
        for (const ComponentId c : step(j).components) gone.insert(c);
      passed[i] = passed_by(step(i), directions[i], gone);
    });
    return passed;
  }

  std::vector<ComponentId> passed_by(const PlanStep& own, DirectionId direction, const ComponentSet& gone) {
    std::vector<ComponentId> passed;
    if (own.poses.empty()) {
      for (const ComponentId c : own.components)
        for (const ComponentId blocker : with_.table.blockers(c, direction, gone)) passed.push_back(blocker);
      return passed;
    }
    const Aabb box = box_around_way(with_.planned.assembly, own, size_);
    for (const ComponentId c : gone.members())
      if (overlaps(box, assembled_bounds(with_.planned.assembly[c]))) passed.push_back(c);
    return passed;
  }

  /// What had to be gone for a step to be made by somebody who reaches for it; nothing if it was the last resort.
  std::optional<std::vector<ComponentId>> opening(std::uint32_t i, const ComponentSet& left, const ComponentSet& gone) {
    const PlanStep& own = step(i);
    if (with_.relations.fastener_of(own.components).valid()) return std::vector<ComponentId>{};
    const bool is_one = own.components.size() == with_.table.groups().of(own.components.front()).size();
    if (!is_one ||
        (own.tier != PlanTier::Straight && own.tier != PlanTier::StraightTogether && own.tier != PlanTier::Helical))
      return std::nullopt;
    for (const ComponentId c : own.components)
      if (exposure_.is_exposed(c, body_)) return std::vector<ComponentId>{};
    std::optional<std::vector<ComponentId>> least;
    for (const ComponentId c : own.components) {
      auto found = exposure_.opened_by(c, left, gone);
      if (found && (!least || found->size() < least->size())) least = std::move(found);
    }
    return least;
  }

  void add_supports(std::vector<OrderedStep>& steps) {
    const DirectionId down = with_.table.add_direction({0, 0, -1});
    for (std::uint32_t i = 0; i < steps.size(); ++i) {
      bool stays = false;
      for (const ComponentId c : step(i).components)
        for (const ComponentId below : with_.table.blockers(c, down, body_)) {
          if (step_of_[below.value] == i) continue;
          stays |= step_of_[below.value] == kNoStep;
          if (!stays) add_unique(steps[i].rests_on, step_of_[below.value]);
        }
      if (stays) steps[i].rests_on.clear();
    }
  }

  /// True if each straight step is free with what is present now and was not when it was validated.
  bool is_valid(const Indices& order) {
    ComponentSet left = body_;
    std::vector<bool> done(order.size());
    for (const std::uint32_t i : order) {
      const PlanStep& own = step(i);
      bool passes_more = false;
      for (std::uint32_t j = 0; j < i; ++j) passes_more |= !done[j];
      if (passes_more && own.poses.empty()) {
        if (!with_.keep_going()) return false;
        const DirectionId direction = with_.table.add_direction(own.exit);
        double way = 0;
        for (const ComponentId c : own.components) way = std::max(way, with_.table.exit_distance(c, direction));
        with_.validator.stand(left);
        if (!with_.validator.try_straight(own.components, own.exit, way).free) return false;
      }
      done[i] = true;
      left.erase(own.components);
    }
    return true;
  }

  const Plan& plan_;
  const Indices& members_;
  const ComponentSet& body_;
  const PlanOrderContext& with_;
  Exposure& exposure_;
  double size_;
  Indices step_of_;  // of each component: the step that removes it
};

/// Orders of the sections, one after another: that of a body, then those of the bodies that its steps remove.
class PlanOrder {
 public:
  PlanOrder(const Plan& plan, const PlanOrderContext& with)
      : plan_(plan),
        with_(with),
        kinds_(with.planned.assembly, with.fasteners),
        exposure_(with.planned.assembly, with.planned.features),
        weights_(with.weights) {
    for (std::uint32_t k = 0; k < plan.steps.size(); ++k) members_[plan.steps[k].part_of].push_back(k);
  }

  Indices run() {
    add(PlanStep::kWhole, ComponentSet::all(with_.planned.size()));
    return std::move(order_);
  }

 private:
  void add(std::uint32_t body, const ComponentSet& components) {
    const auto found = members_.find(body);
    if (found == members_.end()) return;
    const Indices own = SectionOrder(plan_, found->second, components, with_, exposure_).run(kinds_, weights_);
    order_.insert(order_.end(), own.begin(), own.end());
    for (const std::uint32_t k : own) add(k, ComponentSet(with_.planned.size(), plan_.steps[k].components));
  }

  const Plan& plan_;
  const PlanOrderContext& with_;
  StepKinds kinds_;
  Exposure exposure_;
  OrderWeights weights_;
  std::map<std::uint32_t, Indices> members_;  // steps by what they take apart
  Indices order_;
};

std::size_t torn(const Plan& plan) {
  std::size_t count = 0;
  for (const PlanStep& step : plan.steps) count += step.still_held_by.size();
  return count;
}

}  // namespace

OrderWeights order_weights(const std::vector<StepPreference>& preferences, const std::vector<double>& weights) {
  DISMANTLE_EXPECT(weights.empty() || weights.size() == preferences.size());
  if (preferences.empty()) return {};
  OrderWeights order{0, 0, 0, 0, 0, 0};
  double by_place = 1;
  for (std::size_t i = preferences.size(); i-- > 0; by_place *= kMoreImportant) {
    const double weight = weights.empty() ? by_place : weights[i];
    switch (preferences[i]) {
      case StepPreference::Direction:
        order.direction = weight;
        break;
      case StepPreference::Upright:
        order.upright = weight;
        break;
      case StepPreference::Groups:
        order.groups = weight;
        break;
      case StepPreference::Support:
        order.support = weight;
        break;
      case StepPreference::Tools:
        order.tools = weight;
        break;
      case StepPreference::Loose:
        order.loose = weight;
        break;
    }
  }
  return order;
}

Plan in_good_order(const Plan& plan, const PlanOrderContext& with) {
  if (plan.steps.size() < 2 || !with.keep_going()) return plan;
  with.table.postpone_hard(true);
  const Indices order = PlanOrder(plan, with).run();
  with.table.postpone_hard(false);
  if (std::is_sorted(order.begin(), order.end()) || !with.keep_going()) return plan;
  Plan ordered = reordered(plan, order);
  std::map<std::uint32_t, ComponentSet> left;  // of each body
  for (PlanStep& step : ordered.steps) {
    const bool is_whole = step.part_of == PlanStep::kWhole;
    ComponentSet all = is_whole ? ComponentSet::all(with.planned.size())
                                : ComponentSet(with.planned.size(), ordered.steps[step.part_of].components);
    ComponentSet& present = left.try_emplace(step.part_of, std::move(all)).first->second;
    with.describe(step, present);
    present.erase(step.components);
  }
  return torn(ordered) > torn(plan) ? plan : ordered;
}

}  // namespace dismantle
