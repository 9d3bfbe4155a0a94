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

/// What the planner is asked for.
enum class SearchKind {
  Plan,     ///< How the assembly comes apart, or a target out of it, from the assembled state.
  TakeOut,  ///< How some components get out from where everything is now.
  Why,      ///< What keeps a component where it is now.
};

/// "plan", "find_path", "why": as docs/wire.md has it.
std::string_view name_of(SearchKind kind);

/// What a search looks at: some of a session's components, as an assembly of their own whose assembled state is where
/// they stand.
struct Standing {
  Assembly assembly;
  PairStates pairs;
  std::vector<ComponentId> components;  ///< Of the session, ordered; index: component of `assembly`.
  std::vector<Pose> poses;              ///< Where they stand, in the session's terms.
};

/// Everything, assembled.
Standing assembled(const Session& session);
/// What is not taken away, where it is now.
Standing standing(const Session& session);
/// Whether it is still what standing() would give.
bool still_stands(const Standing& standing, const Session& session);

struct Search {
  SearchKind kind = SearchKind::Plan;
  std::shared_ptr<const Standing> standing;
  std::vector<ComponentId> targets;  ///< Of the session, all in `standing`; of Why: one; of Plan none: everything.
  std::vector<ComponentId> fixed;    ///< Of the session, none of them a target. These never move.
  std::vector<StepPreference> preferences;  ///< See PlanOptions.
  CertificateOptions engine;
};

/// What the user sees while it goes on.
std::string search_name(const Search& search);

/// What a search has found, in the terms of the session that it was made for.
struct Finding {
  SearchKind kind = SearchKind::Plan;
  std::shared_ptr<const Standing> standing;
  bool complete = false;  ///< All that was asked for comes out.
  bool out_of_time = false;
  double seconds = 0;
  std::size_t steps = 0;
  std::vector<Explanation> reasons;  ///< Why what shall come out does not.
  Path path;                         ///< Of Plan.
  std::vector<Removal> removals;     ///< Of TakeOut, where complete.
};

/// Takes seconds to minutes. Errors: Failed where `progress` cancelled.
Result<Finding> run_search(const Search& search, const ProgressCallback& progress);

/// The member `search` of the event `state`.
Json search_json(const Finding& finding);

}  // namespace dismantle::server
