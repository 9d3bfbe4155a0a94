// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"
#include "dismantle/planner/plan_disassembly.h"
#include "dismantle/planner/step_preference.h"
#include "dismantle/session/session.h"

#include "apps/server/session_json.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dismantle::server {

/// Engine options for work beside a session, whose drag keeps a thread. @param session options of its engine
CertificateOptions engine_beside(const CertificateOptions& session);

/// The kinds of searches of the planner.
enum class SearchKind {
  Plan,     ///< A disassembly sequence of everything or of targets, from the assembled state.
  TakeOut,  ///< Removal paths of components, from the current state.
  Why,      ///< The blockers of one component in the current state.
};

/// The name of a kind in docs/wire.md: "plan", "find_path", "why".
std::string_view name_of(SearchKind kind);

/// A copy of a session's state for a search, which runs beside the session: some of its components as an assembly of
/// their own, whose assembled state is their current poses.
struct SessionSnapshot {
  Assembly assembly;                    ///< The components at their current poses.
  PairStates pairs;                     ///< Of `assembly`.
  std::vector<ComponentId> components;  ///< Ids in the session, ascending; index: component of `assembly`.
  std::vector<Pose> poses;              ///< Poses in the session; index as above.
  /// Surfaces prepared by the session's engine; the search uses those of components that are still in place.
  std::shared_ptr<const AssemblySurfaces> prepared;
};

/// A snapshot of all components in the assembled state.
SessionSnapshot assembled_snapshot(const Session& session);
/// A snapshot of the components that are not removed, at their current poses.
SessionSnapshot current_snapshot(const Session& session);
/// True if current_snapshot() would return the same components and poses.
bool is_current(const SessionSnapshot& snapshot, const Session& session);

/// A search to run. Component ids are those of the session.
struct SearchRequest {
  SearchKind kind = SearchKind::Plan;               ///< What to search for.
  std::shared_ptr<const SessionSnapshot> snapshot;  ///< The state to search from; never null when run.
  std::vector<ComponentId> targets;                 ///< All in `snapshot`. Why: one; Plan: none for everything.
  std::vector<ComponentId> fixed;                   ///< Plan: components that never move, none of them a target.
  ChosenPreferences preferences;                    ///< See PlanOptions.
  CertificateOptions engine;                        ///< Of the session's engine; one thread is left to the session.
  double effort = 1;                                ///< See PlanOptions::search_longer().
};

/// The name of the job, for the user. @pre the request has a snapshot
std::string search_name(const SearchRequest& request);

/// The shortest known sequence of removals that frees a component.
struct RemovalChain {
  std::vector<std::vector<ComponentId>> before;  ///< Sets that go out together, in their order.
  Vec3 direction;                                ///< In which the component then leaves; unit.
};

/// The result of a search. Component ids and poses are those of the session.
struct SearchResult {
  SearchKind kind = SearchKind::Plan;               ///< As requested.
  std::shared_ptr<const SessionSnapshot> snapshot;  ///< As requested.
  bool complete = false;                            ///< All targets can be removed.
  bool out_of_time = false;                         ///< The search reached its time limit.
  bool effort_spent = false;                        ///< See Plan::effort_spent.
  double effort = 1;                                ///< As requested.
  bool cancelled = false;                           ///< The user ended the search; what was found until then is here.
  double seconds = 0;                               ///< Duration of the search [s].
  std::size_t steps = 0;                            ///< Number of steps of the plan.
  std::vector<Explanation> reasons;                 ///< The blockers of each target that cannot be removed.
  std::optional<RemovalChain> chain;                ///< Why: if it was found in a few seconds.
  Path path;                                        ///< The path of the plan.
  std::vector<Removal> removals;                    ///< TakeOut, if complete: the motions to carry out.
};

/// Runs a search, which takes seconds to minutes. For any thread. Errors: Failed if `progress` cancels; a plan of
/// which some steps were found by then is returned.
Result<SearchResult> run_search(const SearchRequest& request, const ProgressCallback& progress);

/// The member `search` of the event `state`.
Json search_json(const SearchResult& result);

}  // namespace dismantle::server
