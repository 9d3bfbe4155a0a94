// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/curved_steps.h"

#include "dismantle/planner/search/sample_search.h"

#include <algorithm>
#include <cmath>

namespace dismantle {

namespace {

/// No longer random search is made for a component whose best excursion was below this [radii]: it only rattles in its
/// seat.
constexpr double kRoom = 0.5;
/// A thread stops straight motion along its axis within this many leads.
constexpr double kHeldLeads = 2;

}  // namespace

CurvedSteps::CurvedSteps(const PlannedAssembly& planned, const CurvedSearch& search, std::size_t slide_effort,
                         std::size_t sample_effort)
    : with_(search), axes_(planned, search.validator), sliding_(slide_effort), sampling_(sample_effort) {
  for (const ComponentPair& pair : search.validator.engine().overlapping_pairs()) overlapping_.emplace(pair.a, pair.b);
}

std::optional<PlanStep> CurvedSteps::find_screwed(const ComponentSet& body, const ComponentSet& staying, Groups groups,
                                                  const JointRelations* joints) {
  for (const ComponentId c : smallest_first(body, staying)) {
    if ((with_.groups.of(c).size() > 1) != (groups == Groups::OfSeveral)) continue;
    for (const NeighbourThread& touched : axes_.threads_of(c)) {
      const auto& [neighbour, thread] = touched;
      if (!with_.keep_going()) return std::nullopt;
      if (!body.has(neighbour) || with_.groups.together(c, neighbour) || !axes_.may_turn(c, thread, body)) continue;
      if (joints != nullptr && joints->blocker(c, thread.direction, body) &&
          joints->blocker(c, -thread.direction, body))
        continue;
      std::vector<ComponentId>& met = met_[{c, neighbour}];
      if (!met.empty() && body.has_all(met)) continue;
      if (!holds(c, touched)) continue;
      PathSearch search = screw_out(with_.validator, with_.table, c, thread, with_.keep_going);
      if (search.step) return with_group(std::move(*search.step));
      met = std::move(search.met);
    }
  }
  return std::nullopt;
}

/// True if a thread keeps two components from moving straight along its axis, either way: by two leads, within which
/// flanks meet, or, where the two may overlap so that flanks may pass each other, from parting. The contact faces of a
/// wheel and its shaft can be mistaken for a thread, and unscrewing the wheel would take thousands of steps.
/// @param thread of ComponentAxes::threads_of(c)
bool CurvedSteps::holds(ComponentId c, const NeighbourThread& thread) {
  const auto [known, is_new] = held_.try_emplace(&thread, true);
  if (!is_new) return known->second;
  const bool may_overlap = overlapping_.count(std::minmax(c, thread.neighbour)) > 0;
  const double way = may_overlap ? with_.table.max_exit_distance(c) : kHeldLeads * std::abs(thread.thread.lead);
  for (const Vec3& direction : {thread.thread.direction, -thread.thread.direction})
    known->second = known->second && with_.validator.engine().straight_contact(c, thread.neighbour, way * direction,
                                                                               StraightSearch::Quick);
  return known->second;
}

std::optional<PlanStep> CurvedSteps::find_sliding(const ComponentSet& body, const ComponentSet& staying) {
  return find_long(sliding_, body, staying, [&](ComponentId c, std::size_t effort) {
    SlideMoves moves = axes_.slide_moves(c, body, with_.choice, with_.table);
    moves.max_effort = effort;
    return slide_out(with_.validator, with_.table, c, moves, with_.keep_going);
  });
}

std::optional<PlanStep> CurvedSteps::find_sampled(const ComponentSet& body, const ComponentSet& staying) {
  return find_long(sampling_, body, staying, [&](ComponentId c, std::size_t effort) {
    const LongSearches::InVain& slid = sliding_.last(c);
    const double room = std::max(slid.furthest.value_or(0), sampling_.last(c).furthest.value_or(0));
    const bool held_fast = slid.effort > 0 && !slid.furthest;
    const bool rattles = effort > LongSearches::kFirstEffort && room < kRoom;
    if (held_fast || rattles) return PathSearch{std::nullopt, slid.met, slid.furthest, true};
    return sample_out(with_.validator, with_.table, c, effort, with_.keep_going);
  });
}

/// A step by LongSearches for one component, with its group; the smallest first.
template <class Search>
std::optional<PlanStep> CurvedSteps::find_long(LongSearches& searches, const ComponentSet& body,
                                               const ComponentSet& staying, const Search& search) {
  std::vector<ComponentId> components = smallest_first(body, staying);
  std::erase_if(components, [this](ComponentId c) { return with_.table.leader_of(c) != c; });
  auto step = searches.find(components, body, with_.validator, with_.keep_going, search);
  return step ? std::optional(with_group(std::move(*step))) : std::nullopt;
}

bool CurvedSteps::may_find_more(Span<const Explanation> staying) const {
  return std::any_of(staying.begin(), staying.end(), [this](const Explanation& e) {
    return sliding_.may_find_more(e.component) || sampling_.may_find_more(e.component);
  });
}

/// A step of a component as that of its group.
PlanStep CurvedSteps::with_group(PlanStep step) const {
  const Span<const ComponentId> group = with_.groups.of(step.components.front());
  step.components.assign(group.begin(), group.end());
  return step;
}

std::vector<ComponentId> CurvedSteps::smallest_first(const ComponentSet& body, const ComponentSet& staying) const {
  std::vector<ComponentId> members = body.members();
  std::erase_if(members, [&](ComponentId c) { return staying.has(c); });
  std::stable_sort(members.begin(), members.end(), [this](ComponentId a, ComponentId b) {
    return with_.features[a.value].radius < with_.features[b.value].radius;
  });
  return members;
}

}  // namespace dismantle
