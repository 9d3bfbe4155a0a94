// SPDX-License-Identifier: Apache-2.0
#include "apps/server/search.h"

#include "dismantle/planner/plan_path.h"

#include <algorithm>

namespace dismantle::server {

namespace {

/// Time limit of the search for what has to be removed before a component [s].
constexpr double kChainSeconds = 5;

/// The id of a session's component in the snapshot; invalid if it is not there.
ComponentId local(const SessionSnapshot& snapshot, ComponentId component) {
  const auto found = std::lower_bound(snapshot.components.begin(), snapshot.components.end(), component);
  if (found == snapshot.components.end() || *found != component) return {};
  return ComponentId(static_cast<std::uint32_t>(found - snapshot.components.begin()));
}

std::vector<ComponentId> local(const SessionSnapshot& snapshot, const std::vector<ComponentId>& components) {
  std::vector<ComponentId> found = components;
  for (ComponentId& c : found) c = local(snapshot, c);
  return found;
}

/// The pairs of the snapshot, without overlapping pairs that have parted.
PairStates pairs_of(const SessionSnapshot& snapshot, const PairStates& all,
                    const std::vector<ComponentPair>& overlapping) {
  PairStates pairs;
  pairs.tolerance = all.tolerance;
  for (ComponentPair p : all.pairs) {
    const auto is_same = [&](const ComponentPair& e) { return e.a == p.a && e.b == p.b; };
    const bool overlapped = p.state == PairState::Overlapping || p.state == PairState::Free;
    if (overlapped && std::none_of(overlapping.begin(), overlapping.end(), is_same)) continue;
    p.a = local(snapshot, p.a);
    p.b = local(snapshot, p.b);
    if (p.a.valid() && p.b.valid()) pairs.pairs.push_back(p);
  }
  return pairs;
}

PlanOptions plan_options(const SearchRequest& request, const ProgressCallback& progress) {
  const SessionSnapshot& snapshot = *request.snapshot;
  PlanOptions options;
  options.targets = local(snapshot, request.targets);
  options.fixed = local(snapshot, request.fixed);
  options.engine = engine_beside(request.engine);
  options.progress = progress;
  options.engine.prepared = snapshot.prepared;
  options.preferences = request.preferences.criteria;
  options.preference_weights = request.preferences.weights;
  options.search_longer(request.effort);
  return options;
}

/// The steps of a plan as removals of the session.
std::vector<Removal> removals_of(const SessionSnapshot& snapshot, const Plan& plan, const Path& path) {
  std::vector<Removal> removals;
  for (std::size_t k = 0; k < plan.steps.size(); ++k) {
    const PlanStep& step = plan.steps[k];
    const std::vector<Frame>& frames = path.moves[k].frames;
    const Pose body = inverse(frames.front().pose);
    Removal removal;
    for (const ComponentId c : step.components) removal.components.push_back(snapshot.components[c.value]);
    removal.from = snapshot.poses[step.components[0].value];
    for (const Frame& f : frames) removal.frames.push_back({f.time, body * f.pose});
    if (step.part_of == PlanStep::kWhole) removal.exit = step.exit;
    removals.push_back(std::move(removal));
  }
  return removals;
}

/// The explanation with the session's component ids.
Explanation translated(const SessionSnapshot& snapshot, Explanation e) {
  const auto translate = [&](ComponentId& c) { c = snapshot.components[c.value]; };
  translate(e.component);
  for (ComponentId& c : e.group) translate(c);
  for (Blocker& b : e.blockers) translate(b.component);
  for (ComponentId& c : e.together) translate(c);
  for (ComponentId& c : e.locked) translate(c);
  return e;
}

SearchResult result_of(const SearchRequest& request, const Plan& plan) {
  const SessionSnapshot& snapshot = *request.snapshot;
  SearchResult result;
  result.kind = request.kind;
  result.snapshot = request.snapshot;
  result.complete = plan.complete();
  result.out_of_time = plan.out_of_time;
  result.effort_spent = plan.effort_spent;
  result.effort = request.effort;
  result.seconds = plan.seconds;
  result.steps = plan.steps.size();
  for (const Explanation& reason : plan.staying) result.reasons.push_back(translated(snapshot, reason));
  result.path = plan_path(snapshot.assembly, snapshot.pairs, plan);
  if (request.kind == SearchKind::TakeOut && plan.complete())
    result.removals = removals_of(snapshot, plan, result.path);
  return result;
}

/// The components to remove before the target, as few as possible and in order; none if nothing is found in time.
std::optional<RemovalChain> chain_to(const SearchRequest& request, PlanOptions options) {
  const SessionSnapshot& snapshot = *request.snapshot;
  options.time_limit = kChainSeconds;
  const ComponentId target = options.targets[0];
  const Plan plan = plan_disassembly(snapshot.assembly, snapshot.pairs, options);
  if (!plan.complete()) return {};
  RemovalChain chain;
  for (const PlanStep& step : plan.steps) {
    chain.direction = step.exit;
    if (std::find(step.components.begin(), step.components.end(), target) != step.components.end()) return chain;
    chain.before.push_back(step.components);
    for (ComponentId& c : chain.before.back()) c = snapshot.components[c.value];
  }
  return {};
}

SearchResult explained(const SearchRequest& request, const PlanOptions& options) {
  const SessionSnapshot& snapshot = *request.snapshot;
  SearchResult result;
  result.kind = request.kind;
  result.snapshot = request.snapshot;
  result.reasons.push_back(
      translated(snapshot, why_blocked(snapshot.assembly, snapshot.pairs, options.targets[0], options)));
  if (!result.reasons[0].blockers.empty()) result.chain = chain_to(request, options);
  return result;
}

}  // namespace

CertificateOptions engine_beside(const CertificateOptions& session) {
  const Executor& executor = session.executor;
  if (executor.kind() != ExecutorKind::Threads || executor.thread_count() < 3) return {Executor(), session.lanes};
  return {Executor(ExecutorKind::Threads, executor.thread_count() - 1), session.lanes};
}

std::string_view name_of(SearchKind kind) {
  switch (kind) {
    case SearchKind::Plan:
      return "plan";
    case SearchKind::TakeOut:
      return "find_path";
    case SearchKind::Why:
      return "why";
  }
  return "";
}

SessionSnapshot assembled_snapshot(const Session& session) {
  SessionSnapshot all{session.assembly(), session.pairs(), {}, {}, session.engine().surfaces()};
  for (std::uint32_t c = 0; c < all.assembly.components.size(); ++c) all.components.emplace_back(c);
  all.poses.resize(all.components.size());
  return all;
}

SessionSnapshot current_snapshot(const Session& session) {
  SessionSnapshot current{session.assembly(), {}, {}, {}, session.engine().surfaces()};
  current.assembly.components.clear();
  for (std::uint32_t c = 0; c < session.poses().size(); ++c) {
    if (session.is_removed(ComponentId(c))) continue;
    current.components.emplace_back(c);
    current.poses.push_back(session.poses()[c]);
    Component moved = session.assembly().components[c];
    moved.assembly_from_mesh = transform_from_pose(current.poses.back()) * moved.assembly_from_mesh;
    current.assembly.components.push_back(std::move(moved));
  }
  current.pairs = pairs_of(current, session.pairs(), session.engine().overlapping_pairs());
  return current;
}

bool is_current(const SessionSnapshot& snapshot, const Session& session) {
  std::size_t next = 0;
  for (std::uint32_t c = 0; c < session.poses().size(); ++c) {
    if (session.is_removed(ComponentId(c))) continue;
    if (next == snapshot.components.size() || snapshot.components[next] != ComponentId(c) ||
        !(snapshot.poses[next] == session.poses()[c]))
      return false;
    ++next;
  }
  return next == snapshot.components.size();
}

std::string search_name(const SearchRequest& request) {
  if (request.targets.empty()) return "Planning " + request.snapshot->assembly.source_file;
  std::string names = names_of(request.snapshot->assembly, local(*request.snapshot, request.targets));
  switch (request.kind) {
    case SearchKind::Plan:
      return "Planning the removal of " + names;
    case SearchKind::TakeOut:
      return "Path for " + names;
    case SearchKind::Why:
      return "Blockers of " + names;
  }
  return names;
}

Result<SearchResult> run_search(const SearchRequest& request, const ProgressCallback& progress) {
  bool cancelled = false;
  const ProgressCallback watched = [&](std::string_view stage, double fraction) {
    cancelled |= !report_progress(progress, stage, fraction);
    return !cancelled;
  };
  SearchResult result;
  if (request.kind == SearchKind::Why) {
    result = explained(request, plan_options(request, watched));
  } else {
    const SessionSnapshot& snapshot = *request.snapshot;
    result = result_of(request, plan_disassembly(snapshot.assembly, snapshot.pairs, plan_options(request, watched)));
  }
  report_progress(watched, "planning", 1);
  result.cancelled = cancelled;
  const bool is_useful = request.kind == SearchKind::Plan && result.steps > 0;
  if (cancelled && !is_useful) return Error{ErrorKind::Failed, "cancelled"};
  return result;
}

namespace {

Json chain_json(const SearchResult& result) {
  if (!result.chain) return nullptr;
  Json before = Json::array();
  for (const std::vector<ComponentId>& step : result.chain->before)
    before.push_back(to_json(Span<const ComponentId>(step)));
  return {{"before", std::move(before)}, {"direction", to_json(result.chain->direction)}};
}

}  // namespace

Json search_json(const SearchResult& result) {
  Json reasons = Json::array();
  for (const Explanation& e : result.reasons) {
    Json blockers = Json::array();
    for (const Blocker& b : e.blockers)
      blockers.push_back(
          {{"component", b.component.value}, {"distance", b.contact.distance}, {"point", to_json(b.contact.point)}});
    reasons.push_back({{"component", e.component.value},
                       {"direction", to_json(e.direction)},
                       {"blockers", std::move(blockers)},
                       {"together", to_json(Span<const ComponentId>(e.together))},
                       {"locked", to_json(Span<const ComponentId>(e.locked))}});
  }
  return {{"kind", name_of(result.kind)},        {"complete", result.complete},
          {"out_of_time", result.out_of_time},   {"effort", result.effort},
          {"effort_spent", result.effort_spent}, {"cancelled", result.cancelled},
          {"seconds", result.seconds},           {"steps", result.steps},
          {"reasons", std::move(reasons)},       {"chain", chain_json(result)}};
}

}  // namespace dismantle::server
