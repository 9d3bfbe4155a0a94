// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/order/step_relations.h"

#include "dismantle/planner/precedence_graph.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace dismantle {

namespace {

constexpr std::uint32_t kNoStep = OrderedStep::kNone;
/// As many steps are examined side by side; what is before one of them follows only from steps of earlier lots.
constexpr std::uint32_t kLot = 64;

using Indices = std::vector<std::uint32_t>;

void add_unique(Indices& list, std::uint32_t index) {
  const auto at = std::lower_bound(list.begin(), list.end(), index);
  if (at == list.end() || *at != index) list.insert(at, index);
}

/// The steps that are before each step by those that are before it, theirs, and so on.
class Ancestors {
 public:
  explicit Ancestors(std::uint32_t count) : words_((count + 63) / 64), bits_(std::size_t{count} * words_) {}

  bool has(std::uint32_t step, std::uint32_t earlier) const {
    return (bits_[std::size_t{step} * words_ + earlier / 64] >> (earlier % 64) & 1) != 0;
  }
  /// Adds a step that is before another one, with its ancestors. @pre these are complete
  void add(std::uint32_t step, std::uint32_t earlier) {
    std::uint64_t* const to = &bits_[std::size_t{step} * words_];
    const std::uint64_t* const from = &bits_[std::size_t{earlier} * words_];
    for (std::size_t w = 0; w < words_; ++w) to[w] |= from[w];
    to[earlier / 64] |= std::uint64_t{1} << (earlier % 64);
  }

 private:
  std::size_t words_;
  std::vector<std::uint64_t> bits_;
};

class RelationSearch {
 public:
  RelationSearch(const PlanSection& section, const PlanOrderContext& with, Exposure& exposure)
      : section_(section),
        with_(with),
        exposure_(exposure),
        size_(diagonal(assembled_bounds(with.planned.assembly))),
        step_of_(with.planned.size(), kNoStep),
        ancestors_(section.size()) {
    for (std::uint32_t i = 0; i < section.size(); ++i)
      for (const ComponentId c : section.step(i).components) step_of_[c.value] = i;
  }

  /// A fastener comes before what it holds, and the parts of a stack one after another, where they do: at once, where
  /// nothing is in between.
  void add_joints(std::vector<OrderedStep>& steps) const {
    std::vector<Indices> threaded(steps.size());
    for (const Joint& joint : section_.plan.joints) {
      Indices stack;
      for (const ComponentId c : joint.stack())
        if (step_of_[c.value] != kNoStep) add_unique(stack, step_of_[c.value]);
      for (std::size_t i = 1; i < stack.size(); ++i) {
        add_unique(steps[stack[i]].before, stack[i - 1]);
        if (stack[i] == stack[i - 1] + 1) steps[stack[i - 1]].followed_by = stack[i];
      }
      const ComponentId first = joint.screw.valid() ? joint.screw : joint.nuts.front();
      const std::uint32_t released = step_of_[first.value];
      if (released == kNoStep) continue;
      for (const ComponentId held : joint.held) {
        const std::uint32_t after = step_of_[held.value];
        if (after == kNoStep || after <= released) continue;
        add_unique(steps[after].before, released);
        // A cover is screwed onto its case: without the screws, the cover is loose.
        add_unique(held == joint.thread_in ? threaded[after] : steps[after].held_by, released);
      }
    }
    for (std::uint32_t i = 0; i < steps.size(); ++i)
      if (steps[i].held_by.empty()) steps[i].held_by = std::move(threaded[i]);
  }

  /// Adds the steps that remove obstacles from the way of each step, and those that expose its components.
  void add_passed(std::vector<OrderedStep>& steps) {
    for (std::uint32_t i = 0; i < section_.size(); ++i)
      directions_.push_back(with_.table.add_direction(section_.step(i).exit));
    ComponentSet gone(with_.planned.size());
    std::uint32_t last_resort = kNoStep;
    for (std::uint32_t begin = 0; begin < steps.size() && with_.keep_going(); begin += kLot) {
      const std::uint32_t end = std::min(section_.size(), begin + kLot);
      std::vector<Needs> needs(end - begin);
      with_.executor.for_each_heavy(needs.size(), [&](std::size_t k) {
        if (with_.keep_going()) needs[k] = needs_of(steps, begin, begin + static_cast<std::uint32_t>(k), gone);
      });
      for (std::uint32_t i = begin; i < end; ++i) {
        for (const std::uint32_t j : needs[i - begin].steps) add_unique(steps[i].before, j);
        if (needs[i - begin].is_last_resort && steps[i].held_by.empty()) {
          // After all others; those before the previous last resort follow from that.
          for (std::uint32_t j = last_resort == kNoStep ? 0 : last_resort; j < i; ++j) add_unique(steps[i].before, j);
          last_resort = i;
        }
        for (const std::uint32_t j : steps[i].before) ancestors_.add(i, j);
        for (const ComponentId c : section_.step(i).components) gone.insert(c);
      }
    }
  }

  void add_supports(std::vector<OrderedStep>& steps) {
    const DirectionId down = with_.table.add_direction({0, 0, -1});
    for (std::uint32_t i = 0; i < steps.size(); ++i) {
      bool stays = false;
      for (const ComponentId c : section_.step(i).components)
        for (const ComponentId below : with_.table.blockers(c, down, section_.body)) {
          if (step_of_[below.value] == i) continue;
          stays |= step_of_[below.value] == kNoStep;
          if (!stays) add_unique(steps[i].rests_on, step_of_[below.value]);
        }
      if (stays) steps[i].rests_on.clear();
    }
  }

 private:
  /// The prerequisites of a step.
  struct Needs {
    Indices steps;  // that come before it
    bool is_last_resort = false;
  };

  /// @param gone before the lot that begins at `begin`
  Needs needs_of(const std::vector<OrderedStep>& steps, std::uint32_t begin, std::uint32_t i, ComponentSet gone) {
    for (std::uint32_t j = begin; j < i; ++j)
      for (const ComponentId c : section_.step(j).components) gone.insert(c);
    Needs needs;
    needs.steps = passed_by(i, gone, steps[i].before);
    ComponentSet left = section_.body;
    left.erase(gone.members());
    if (const auto opened_by = opening(section_.step(i), left, gone))
      for (const ComponentId c : *opened_by) needs.steps.push_back(step_of_[c.value]);
    else
      needs.is_last_resort = true;
    return needs;
  }

  /// Steps that remove what lies in the way of a step. @param known steps that come before it in any case
  Indices passed_by(std::uint32_t i, const ComponentSet& gone, Indices known) {
    const std::size_t already = known.size();
    const auto follows = [&](std::uint32_t j) {
      return std::any_of(known.begin(), known.end(), [&](std::uint32_t k) { return k == j || ancestors_.has(k, j); });
    };
    // Steps from the last one: most of those before it follow from it.
    if (const PlanStep& own = section_.step(i); own.poses.empty()) {
      for (const auto& [j, moving, fixed] : near_way(own, directions_[i], gone))
        if (!follows(j) && with_.table.blocks(moving, directions_[i], fixed)) known.push_back(j);
    } else {
      const Aabb box = box_around_way(with_.planned.assembly, own, size_);
      for (std::uint32_t j = i; j-- > 0;)
        for (const ComponentId c : section_.step(j).components)
          if (overlaps(box, assembled_bounds(with_.planned.assembly[c])) && !follows(j)) known.push_back(j);
    }
    known.erase(known.begin(), known.begin() + static_cast<std::ptrdiff_t>(already));
    return known;
  }

  /// A component that a step moves, and one near its way that an earlier step removes.
  struct NearWay {
    std::uint32_t step;
    ComponentId moving, fixed;
  };

  std::vector<NearWay> near_way(const PlanStep& own, DirectionId direction, const ComponentSet& gone) {
    std::vector<NearWay> near;
    for (const ComponentId moving : own.components)
      for (const ComponentId fixed : with_.table.near(moving, direction))
        if (gone.has(fixed)) near.push_back({step_of_[fixed.value], moving, fixed});
    std::stable_sort(near.begin(), near.end(), [](const NearWay& a, const NearWay& b) { return a.step > b.step; });
    return near;
  }

  /// The components whose removal exposes those of a step; nothing if the step was made although they are enclosed, or
  /// is a last resort anyway: curved, or of several components.
  std::optional<std::vector<ComponentId>> opening(const PlanStep& own, const ComponentSet& left,
                                                  const ComponentSet& gone) {
    if (with_.relations.fastener_of(own.components).valid()) return std::vector<ComponentId>{};
    const bool is_one = own.components.size() == with_.table.groups().of(own.components.front()).size();
    if (!is_one ||
        (own.tier != PlanTier::Straight && own.tier != PlanTier::StraightTogether && own.tier != PlanTier::Helical))
      return std::nullopt;
    for (const ComponentId c : own.components)
      if (exposure_.is_exposed(c, section_.body)) return std::vector<ComponentId>{};
    std::optional<std::vector<ComponentId>> least;
    for (const ComponentId c : own.components) {
      auto found = exposure_.opened_by(c, left, gone);
      if (found && (!least || found->size() < least->size())) least = std::move(found);
    }
    return least;
  }

  const PlanSection& section_;
  const PlanOrderContext& with_;
  Exposure& exposure_;
  double size_;
  Indices step_of_;                      // of each component: the step that removes it
  std::vector<DirectionId> directions_;  // of each step
  Ancestors ancestors_;
};

}  // namespace

void find_step_relations(const PlanSection& section, const PlanOrderContext& context, Exposure& exposure,
                         bool with_support, std::vector<OrderedStep>& steps) {
  RelationSearch search(section, context, exposure);
  search.add_joints(steps);
  search.add_passed(steps);
  if (with_support) search.add_supports(steps);
}

}  // namespace dismantle
