// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/order/plan_order.h"

#include "dismantle/planner/order/step_relations.h"
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

using Indices = std::vector<std::uint32_t>;

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

/// Orders of the sections, one after another: that of a body, then those of the bodies that its steps remove.
class PlanOrder {
 public:
  PlanOrder(const Plan& plan, const PlanOrderContext& with)
      : plan_(plan),
        with_(with),
        kinds_(with.planned.assembly, with.fasteners),
        exposure_(with.planned.assembly, with.planned.features) {
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
    const Indices own = ordered({plan_, found->second, components});
    order_.insert(order_.end(), own.begin(), own.end());
    for (const std::uint32_t k : own) add(k, ComponentSet(with_.planned.size(), plan_.steps[k].components));
  }

  /// The members of a section in their best order; as they are, if the search was ended or the order cannot be
  /// validated.
  Indices ordered(const PlanSection& section) {
    std::vector<OrderedStep> steps;
    steps.reserve(section.size());
    for (std::uint32_t i = 0; i < section.size(); ++i) steps.push_back(kinds_.describe(section.step(i)));
    find_step_relations(section, with_, exposure_, with_.weights.support > 0, steps);
    join_stacks(steps);
    if (!with_.keep_going()) return section.members;
    const Indices order = best_order(steps, with_.weights, with_.keep_going);
    if (!is_valid(section, order)) return section.members;
    Indices ordered;
    ordered.reserve(order.size());
    for (const std::uint32_t i : order) ordered.push_back(section.members[i]);
    return ordered;
  }

  /// Has all that is before one of the steps that follow one another at once before the first of them, and makes equal
  /// stacks one kind.
  void join_stacks(std::vector<OrderedStep>& steps) {
    for (std::uint32_t first = 0; first < steps.size(); ++first) {
      std::uint32_t last = first;
      while (steps[last].followed_by != OrderedStep::kNone) last = steps[last].followed_by;
      if (last == first) continue;
      Indices kinds, before;
      for (std::uint32_t i = first; i <= last; ++i) {
        kinds.push_back(steps[i].kind);
        for (const std::uint32_t j : steps[i].before)
          if (j < first) before.push_back(j);
      }
      std::sort(before.begin(), before.end());
      before.erase(std::unique(before.begin(), before.end()), before.end());
      steps[first].before = std::move(before);
      const std::uint32_t kind = kinds_.joined(std::move(kinds));
      for (std::uint32_t i = first; i <= last; ++i) steps[i].kind = kind;
      first = last;
    }
  }

  /// True if each straight step is free with what is present now and was not when it was validated.
  bool is_valid(const PlanSection& section, const Indices& order) const {
    ComponentSet left = section.body;
    std::vector<bool> done(order.size());
    for (const std::uint32_t i : order) {
      const PlanStep& own = section.step(i);
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
  const PlanOrderContext& with_;
  StepKinds kinds_;
  Exposure exposure_;
  std::map<std::uint32_t, Indices> members_;  // steps by what they take apart
  Indices order_;
};

std::size_t torn(const Plan& plan) {
  std::size_t count = 0;
  for (const PlanStep& step : plan.steps) count += step.still_held_by.size();
  return count;
}

}  // namespace

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
