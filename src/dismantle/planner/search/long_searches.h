// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/keep_going.h"
#include "dismantle/core/span.h"
#include "dismantle/planner/component_set.h"
#include "dismantle/planner/search/local_planner.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace dismantle {

/// Searches of one kind for paths that are not straight, for one component after another: their effort grows from round
/// to round, and what a search has met is remembered.
class LongSearches {
 public:
  /// The last search for a component, which was in vain.
  struct InVain {
    std::size_t effort = 0;          ///< 0: there was none.
    std::vector<ComponentId> met;    ///< As long as all of these are there, no less effort helps.
    std::optional<double> furthest;  ///< PathSearch::furthest
  };

  /// Effort of the first search for each component.
  static constexpr std::size_t kFirstEffort = 40'000;

  /// @param max_effort of all searches together
  explicit LongSearches(std::size_t max_effort) : max_effort_(max_effort) {}

  /// The last search for a component.
  const InVain& last(ComponentId c) { return in_vain_[c]; }

  /// True if no path was found for a component for want of effort.
  bool may_find_more(ComponentId c) const {
    const auto found = in_vain_.find(c);
    return found == in_vain_.end() ? spent_ >= max_effort_ : found->second.effort != kExhausted;
  }

  /// The path of the first of some components for which there is one, all of them tried with little effort first.
  /// @param body components that are present @param validator measures the effort
  /// @param search (component, effort) -> PathSearch
  template <class Search>
  std::optional<PlanStep> find(Span<const ComponentId> components, const ComponentSet& body,
                               const MotionValidator& validator, const KeepGoing& keep_going, const Search& search) {
    // Less than the first effort is one round with what there is.
    const std::size_t end = kEffortGrowth * std::max(max_effort_, kFirstEffort);
    for (std::size_t effort = kFirstEffort; effort < end; effort *= kEffortGrowth)
      for (const ComponentId c : components) {
        InVain& before = in_vain_[c];
        if (before.effort >= effort && body.has_all(before.met)) continue;
        const std::size_t left = max_effort_ - std::min(spent_, max_effort_);
        if (left == 0 || !keep_going()) return std::nullopt;
        const std::size_t begun = validator.effort();
        PathSearch found = search(c, std::min(effort, left));
        spent_ += validator.effort() - begun;
        if (found.step) return std::move(found.step);
        const bool no_further =
            before.effort > 0 && body.has_all(before.met) && found.furthest <= kFurther * before.furthest.value_or(0);
        before = {found.exhausted || no_further ? kExhausted : effort, std::move(found.met), found.furthest};
      }
    return std::nullopt;
  }

 private:
  /// Growth of the effort from one round over all components to the next.
  static constexpr std::size_t kEffortGrowth = 4;
  /// A component is searched for no longer once a longer search gets less than this many times as far as the one
  /// before.
  static constexpr double kFurther = 1.1;
  /// InVain::effort where more does not help.
  static constexpr std::size_t kExhausted = std::numeric_limits<std::size_t>::max();

  std::size_t max_effort_, spent_ = 0;
  std::map<ComponentId, InVain> in_vain_;
};

}  // namespace dismantle
