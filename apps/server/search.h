// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"
#include "dismantle/planner/plan_disassembly.h"
#include "dismantle/session/session.h"

#include "apps/server/session_json.h"

#include <memory>
#include <string>
#include <vector>

namespace dismantle::server {

/// A request to the planner.
enum class SearchKind {
  Plan,     ///< How the assembly comes apart, or a target out of it, from the assembled state.
  TakeOut,  ///< How some components get out from where everything is now.
  Why,      ///< What keeps a component where it is now.
};

/// "plan", "find_path", "why": as docs/wire.md has it.
std::string_view name_of(SearchKind kind);

/// The input of a search: some of a session's components, as an assembly of their own whose assembled state is where
/// they stand.
struct Standing {
  Assembly assembly;
  PairStates pairs;
  std::vector<ComponentId> components;  ///< Of the session, ordered; index: component of `assembly`.
  std::vector<Pose> poses;              ///< Where they stand, in the session's terms.
};

/// Everything, assembled.
Standing assembled(const Session& session);
/// The components that are not removed, at their present poses.
Standing standing(const Session& session);
/// True if standing() would still give the same.
bool still_stands(const Standing& standing, const Session& session);

struct Search {
  SearchKind kind = SearchKind::Plan;
  std::shared_ptr<const Standing> standing;
  std::vector<ComponentId> targets;  ///< Of the session, all in `standing`; of Why: one; of Plan none: everything.
  std::vector<ComponentId> fixed;    ///< Of the session, none of them a target. These never move.
  std::vector<StepPreference> preferences;  ///< See PlanOptions.
  CertificateOptions engine;
};

/// The name of the search for the user.
std::string search_name(const Search& search);

/// The result of a search, in terms of the session that it was made for.
struct Finding {
  SearchKind kind = SearchKind::Plan;
  std::shared_ptr<const Standing> standing;
  bool complete = false;  ///< Everything that was asked for can be removed.
  bool out_of_time = false;
  double seconds = 0;
  std::size_t steps = 0;
  std::vector<Explanation> reasons;  ///< Why components that were asked for cannot be removed.
  Path path;                         ///< Of Plan.
  std::vector<Removal> removals;     ///< Of TakeOut, where complete.
};

/// Takes seconds to minutes. Errors: Failed where `progress` cancelled.
Result<Finding> run_search(const Search& search, const ProgressCallback& progress);

/// The member `search` of the event `state`.
Json search_json(const Finding& finding);

}  // namespace dismantle::server
