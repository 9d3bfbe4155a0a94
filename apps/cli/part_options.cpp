// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/part_options.h"

#include "apps/cli/plan_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

namespace dismantle::cli {

namespace {

using Json = nlohmann::ordered_json;

/// Lines of proposals that are printed; the others are counted.
constexpr std::size_t kMostProposals = 12;

bool is_flexible(const std::vector<FlexiblePart>& parts, ComponentId c) {
  return std::any_of(parts.begin(), parts.end(), [&](const FlexiblePart& part) { return part.component == c; });
}

/// True if the user has said it already.
bool is_known(const PartChoices& choices, const Proposal& proposal) {
  const ComponentId first = proposal.components[0];
  if (proposal.kind == Proposal::Kind::Flexible) return is_flexible(choices.flexible, first);
  return std::all_of(proposal.components.begin(), proposal.components.end(),
                     [&](ComponentId c) { return choices.named.together(c, first); });
}

/// Makes the groups of what is named and what is accepted.
void unite_accepted(PartChoices& choices) {
  choices.groups = choices.named;
  for (const Proposal& proposal : choices.accepted)
    if (proposal.kind == Proposal::Kind::Together) choices.groups.unite(proposal.components);
}

/// The components that stay in a plan, and those that block them.
std::set<ComponentId> involved_in(const Plan& plan) {
  std::set<ComponentId> involved;
  for (const Explanation& e : plan.staying) {
    involved.insert(e.group.begin(), e.group.end());
    for (const Blocker& blocker : e.blockers) involved.insert(blocker.component);
  }
  return involved;
}

/// Pairs of components that touch or overlap, each in both orders.
using Touching = std::multimap<ComponentId, ComponentId>;

Touching touching_in(const PairStates& states) {
  Touching touching;
  for (const ComponentPair& pair : states.pairs) {
    if (pair.state == PairState::Clear || pair.state == PairState::Near) continue;
    touching.emplace(pair.a, pair.b);
    touching.emplace(pair.b, pair.a);
  }
  return touching;
}

/// True if each of some components touches another one, that the next one, and so on.
bool are_connected(const std::vector<ComponentId>& components, const Touching& touching) {
  std::set<ComponentId> missing(components.begin() + 1, components.end());
  std::vector<ComponentId> reached{components.front()};
  while (!reached.empty()) {
    const auto [begin, end] = touching.equal_range(reached.back());
    reached.pop_back();
    for (auto pair = begin; pair != end; ++pair)
      if (missing.erase(pair->second) > 0) reached.push_back(pair->second);
  }
  return missing.empty();
}

std::string proposal_text(const Assembly& assembly, const Proposal& proposal) {
  if (proposal.kind == Proposal::Kind::Flexible)
    return fmt::format("{} gives by {:.2g} mm ({})", proposal.name, proposal.flexible.overlap, proposal.reason);
  return fmt::format("{} is one part: {} ({})", proposal.name, names_text(assembly, proposal.components),
                     proposal.reason);
}

std::string proposals_text(const Assembly& assembly, const std::string& title, const std::vector<Proposal>& proposals) {
  if (proposals.empty()) return {};
  std::string text = title + "\n";
  const std::size_t shown = std::min(kMostProposals, proposals.size());
  for (std::size_t i = 0; i < shown; ++i) text += fmt::format("  {}\n", proposal_text(assembly, proposals[i]));
  if (shown < proposals.size()) text += fmt::format("  and {} more\n", proposals.size() - shown);
  return text + "\n";
}

}  // namespace

void add_together_option(CLI::App& command, CommonOptions& o) {
  command
      .add_option("--together", o.together,
                  "Treat as one part: each sub-assembly of the product tree that has this name, or fits this pattern "
                  "with * and ?; where there is none, the components that fit, all together. May be repeated")
      ->type_name("NAME|PATTERN");
  const auto accept =
      command.add_flag("--accept-proposals", o.accept_proposals,
                       "Take the proposals of what is one purchased part, or gives, as if --together and "
                       "--flexible named them");
  command.add_flag("--no-proposals", o.no_proposals, "Propose nothing")->excludes(accept);
}

void add_flexible_option(CLI::App& command, CommonOptions& o) {
  command
      .add_option(
          "--flexible", o.flexible,
          "Components that give, by name or pattern: while they or what they touch are moved, the two may get MM "
          "deep in each other (default: the component's thickness). May be repeated")
      ->type_name("NAME[=MM]");
}

Result<PartChoices> choose_parts(const Assembly& assembly, PairStates& states, const CommonOptions& options) {
  PartChoices choices;
  Result<RigidGroups> groups = named_groups(assembly, options.together);
  if (!groups) return groups.error();
  choices.named = std::move(*groups);
  Result<std::vector<FlexiblePart>> flexible = named_flexible(assembly, options.flexible);
  if (!flexible) return flexible.error();
  choices.flexible = std::move(*flexible);
  if (!options.no_proposals) {
    std::vector<Proposal>& into = options.accept_proposals ? choices.accepted : choices.open;
    for (Proposal& proposal : find_proposals(assembly, states))
      if (!is_known(choices, proposal)) into.push_back(std::move(proposal));
  }
  for (const Proposal& proposal : choices.accepted)
    if (proposal.kind == Proposal::Kind::Flexible) choices.flexible.push_back(proposal.flexible);
  unite_accepted(choices);
  allow_flexible(states, choices.flexible);
  return choices;
}

bool take_back_some(PartChoices& choices, const PairStates& states, const Plan& plan) {
  std::set<ComponentId> staying;
  for (const Explanation& e : plan.staying) staying.insert(e.group.begin(), e.group.end());
  const Touching touching = touching_in(states);
  bool has_changed = false;
  for (Proposal& proposal : choices.accepted) {
    if (proposal.kind == Proposal::Kind::Flexible) continue;
    const std::set<ComponentId> members(proposal.components.begin(), proposal.components.end());
    std::set<ComponentId> holding;
    for (const Explanation& e : plan.staying)
      for (const Blocker& blocker : e.blockers)
        if (members.contains(blocker.component) && !members.contains(e.component)) holding.insert(blocker.component);
    if (holding.empty())
      for (const auto& [own, other] : touching)
        if (members.contains(own) && !members.contains(other) && staying.contains(other)) holding.insert(own);
    for (const Joint& joint : plan.joints) {
      const auto is_holding = [&](ComponentId c) { return holding.contains(c); };
      if (std::none_of(joint.held.begin(), joint.held.end(), is_holding)) continue;
      for (const ComponentId c : joint.stack())
        if (members.contains(c)) holding.insert(c);
    }
    if (holding.empty()) continue;
    std::vector<ComponentId> rest = proposal.components;
    std::erase_if(rest, [&](ComponentId c) { return holding.contains(c); });
    if (rest.size() < 2 || !are_connected(rest, touching)) continue;  // chips are one part on their board only
    proposal.components = std::move(rest);
    proposal.reason += fmt::format("; without {} of its components, which block what would stay", holding.size());
    has_changed = true;
  }
  if (has_changed) unite_accepted(choices);
  return has_changed;
}

bool take_back(PartChoices& choices, const Plan& plan) {
  const std::set<ComponentId> involved = involved_in(plan);
  const auto keeps = [&](const Proposal& proposal) {
    return proposal.kind == Proposal::Kind::Flexible ||
           std::none_of(proposal.components.begin(), proposal.components.end(),
                        [&](ComponentId c) { return involved.contains(c); });
  };
  const auto first = std::stable_partition(choices.accepted.begin(), choices.accepted.end(), keeps);
  if (first == choices.accepted.end()) return false;
  choices.taken_back.insert(choices.taken_back.end(), first, choices.accepted.end());
  choices.accepted.erase(first, choices.accepted.end());
  unite_accepted(choices);
  return true;
}

std::string choices_text(const Assembly& assembly, const PartChoices& choices) {
  std::string text;
  for (const std::vector<ComponentId>& group : choices.groups.of_several())
    text += fmt::format("one part: {}\n", names_text(assembly, group));
  for (const FlexiblePart& part : choices.flexible)
    text += fmt::format("gives by {:.2g} mm: {}\n", part.overlap, assembly[part.component].name);
  text += proposals_text(assembly, "Accepted proposals:", choices.accepted);
  text += proposals_text(assembly, "Proposals that are not taken, as something would stay:", choices.taken_back);
  text += proposals_text(assembly, "Proposals (--accept-proposals takes them):", choices.open);
  return text;
}

Json choices_json(const Assembly& assembly, const PartChoices& choices) {
  Json together = Json::array(), flexible = Json::array(), proposals = Json::array();
  for (const std::vector<ComponentId>& group : choices.groups.of_several())
    together.push_back(names_json(assembly, group));
  for (const FlexiblePart& part : choices.flexible)
    flexible.push_back({{"component", assembly[part.component].name}, {"overlap_mm", part.overlap}});
  for (const std::vector<Proposal>* list : {&choices.accepted, &choices.taken_back, &choices.open})
    for (const Proposal& proposal : *list) {
      const bool gives = proposal.kind == Proposal::Kind::Flexible;
      Json entry{{"kind", gives ? "flexible" : "together"},
                 {"name", proposal.name},
                 {"components", names_json(assembly, proposal.components)},
                 {"reason", proposal.reason},
                 {"accepted", list == &choices.accepted}};
      if (gives) entry["overlap_mm"] = proposal.flexible.overlap;
      proposals.push_back(std::move(entry));
    }
  return {{"together", together}, {"flexible", flexible}, {"proposals", proposals}};
}

}  // namespace dismantle::cli
