// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/step_preference.h"

#include "dismantle/files/text_scan.h"

#include <algorithm>
#include <utility>

namespace dismantle {

namespace {

/// Exits within this distance count as the same direction.
constexpr double kSameExit = 1e-6;
/// Exits that point down by more than this sine require turning the assembly over.
constexpr double kDownwards = 0.2;

/// Computes the cost of a removal by each criterion.
class RemovalJudge {
 public:
  RemovalJudge(const RemovalChoice& choice, const ComponentSet& present, const ComponentSet& never,
               const StepBefore& before)
      : choice_(choice),
        present_(present),
        never_(never),
        before_(before),
        down_(choice.table.add_direction({0, 0, -1})) {}

  std::vector<std::size_t> against(const StraightRemoval& removal) {
    std::vector<std::size_t> counts;
    counts.reserve(choice_.preferences.size());
    for (const StepPreference preference : choice_.preferences) counts.push_back(against(removal, preference));
    return counts;
  }

 private:
  std::size_t against(const StraightRemoval& removal, StepPreference preference) {
    const Vec3 exit = choice_.table.direction(removal.direction);
    const ComponentId c = removal.components[0];
    switch (preference) {
      case StepPreference::Direction:
        return length(exit - before_.exit) > kSameExit ? 1 : 0;
      case StepPreference::Upright:
        return exit.z < -kDownwards ? 1 : 0;
      case StepPreference::Groups:
        return before_.component.valid() && choice_.kinds[c.value] == choice_.kinds[before_.component.value] ? 0 : 1;
      case StepPreference::Support:
        return left_loose(c);
      case StepPreference::Tools:
      case StepPreference::Loose:
        return 0;
    }
    return 0;
  }

  /// Number of components that lose their support when `gone` is removed.
  std::size_t left_loose(ComponentId gone) {
    ComponentSet left = present_;
    left.erase(gone);
    std::size_t loose = 0;
    for (const ComponentId c : left.members())
      if (!never_.has(c) && choice_.table.blocks(c, down_, gone) && !choice_.table.any_blocker(c, down_, left)) ++loose;
    return loose;
  }

  const RemovalChoice& choice_;
  const ComponentSet& present_;
  const ComponentSet& never_;
  const StepBefore& before_;
  DirectionId down_;
};

}  // namespace

const std::map<std::string, StepPreference>& step_preferences() {
  static const std::map<std::string, StepPreference> kNames{
      {"direction", StepPreference::Direction}, {"upright", StepPreference::Upright},
      {"groups", StepPreference::Groups},       {"support", StepPreference::Support},
      {"tools", StepPreference::Tools},         {"loose", StepPreference::Loose}};
  return kNames;
}

std::optional<ChosenPreferences> read_preferences(const std::vector<std::string>& texts) {
  std::vector<std::pair<double, StepPreference>> read;
  bool has_weights = false;
  for (const std::string& text : texts) {
    const std::size_t end = std::min(text.find('='), text.size());
    const auto known = step_preferences().find(text.substr(0, end));
    double weight = 1;
    if (end < text.size()) {
      const std::optional<double> number = to_double(std::string_view(text).substr(end + 1));
      if (!number || !(*number > 0)) return std::nullopt;
      weight = *number;
      has_weights = true;
    }
    if (known == step_preferences().end()) return std::nullopt;
    if (std::any_of(read.begin(), read.end(), [&](const auto& other) { return other.second == known->second; }))
      return std::nullopt;
    read.emplace_back(weight, known->second);
  }
  std::stable_sort(read.begin(), read.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  ChosenPreferences chosen;
  for (const auto& [weight, criterion] : read) {
    chosen.criteria.push_back(criterion);
    if (has_weights) chosen.weights.push_back(weight);
  }
  return chosen;
}

std::vector<StraightRemoval> preferred_removals(const RemovalChoice& choice, const ComponentSet& present,
                                                const ComponentSet& never, const StepBefore& before) {
  RemovalJudge judge(choice, present, never, before);
  std::vector<std::pair<std::vector<std::size_t>, StraightRemoval>> found;
  for (const ComponentId c : present.members()) {
    if (never.has(c)) continue;
    for (const DirectionId d : choice.directions[c.value]) {
      if (choice.table.any_blocker(c, d, present)) continue;
      StraightRemoval removal{{c}, d};
      std::vector<std::size_t> against = judge.against(removal);
      found.emplace_back(std::move(against), std::move(removal));
    }
  }
  std::stable_sort(found.begin(), found.end(), [&](const auto& a, const auto& b) {
    if (a.first != b.first) return a.first < b.first;
    const bool a_is_early = choice.early.has(a.second.components[0]);
    if (a_is_early != choice.early.has(b.second.components[0])) return a_is_early;
    return choice.table.radius(a.second.components[0]) < choice.table.radius(b.second.components[0]);
  });
  std::vector<StraightRemoval> removals;
  removals.reserve(found.size());
  for (auto& [against, removal] : found) removals.push_back(std::move(removal));
  return removals;
}

}  // namespace dismantle
