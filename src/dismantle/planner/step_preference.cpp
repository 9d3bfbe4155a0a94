// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/step_preference.h"

#include "dismantle/core/contract.h"
#include "dismantle/files/text_scan.h"

#include <algorithm>
#include <utility>

namespace dismantle {

namespace {

/// A criterion counts as many times as much as the next one.
constexpr double kMoreImportant = 10;

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

}  // namespace dismantle
