// SPDX-License-Identifier: Apache-2.0
#include "apps/server/search.h"

#include "dismantle/planner/plan_path.h"

#include <algorithm>

namespace dismantle::server {

namespace {

/// The index of a session's component within what stands; invalid where it does not.
ComponentId local(const Standing& standing, ComponentId component) {
  const auto found = std::lower_bound(standing.components.begin(), standing.components.end(), component);
  if (found == standing.components.end() || *found != component) return {};
  return ComponentId(static_cast<std::uint32_t>(found - standing.components.begin()));
}

std::vector<ComponentId> local(const Standing& standing, const std::vector<ComponentId>& components) {
  std::vector<ComponentId> found = components;
  for (ComponentId& c : found) c = local(standing, c);
  return found;
}

/// The pairs of what stands; those that were embedded and have parted are pairs no more.
PairStates pairs_of(const Standing& standing, const PairStates& all, const std::vector<ComponentPair>& embedded) {
  PairStates pairs;
  pairs.tolerance = all.tolerance;
  for (ComponentPair p : all.pairs) {
    const auto is_same = [&](const ComponentPair& e) { return e.a == p.a && e.b == p.b; };
    if (p.state == PairState::Embedded && std::none_of(embedded.begin(), embedded.end(), is_same)) continue;
    p.a = local(standing, p.a);
    p.b = local(standing, p.b);
    if (p.a.valid() && p.b.valid()) pairs.pairs.push_back(p);
  }
  return pairs;
}

/// One core is left to the hand.
Executor executor_beside(const Executor& executor) {
  if (executor.kind() != ExecutorKind::Threads || executor.thread_count() < 3) return Executor();
  return Executor(ExecutorKind::Threads, executor.thread_count() - 1);
}

PlanOptions plan_options(const Search& search, const ProgressCallback& progress) {
  const Standing& standing = *search.standing;
  const CertificateOptions engine{executor_beside(search.engine.executor), search.engine.lanes};
  PlanOptions options{local(standing, search.targets), local(standing, search.fixed), 0, engine, progress};
  options.preferences = search.preferences;
  return options;
}

/// The steps of a plan as a session goes them: each set by motions since it was found.
std::vector<Removal> removals_of(const Standing& standing, const Plan& plan, const Path& path) {
  std::vector<Removal> removals;
  for (std::size_t k = 0; k < plan.steps.size(); ++k) {
    const PlanStep& step = plan.steps[k];
    const std::vector<Frame>& frames = path.moves[k].frames;
    const Pose body = inverse(frames.front().pose);
    Removal removal;
    for (const ComponentId c : step.components) removal.components.push_back(standing.components[c.value]);
    removal.from = standing.poses[step.components[0].value];
    for (const Frame& f : frames) removal.frames.push_back({f.time, body * f.pose});
    if (step.part_of == PlanStep::kWhole) removal.exit = step.exit;
    removals.push_back(std::move(removal));
  }
  return removals;
}

/// In the terms of the session.
Explanation translated(const Standing& standing, Explanation e) {
  const auto translate = [&](ComponentId& c) { c = standing.components[c.value]; };
  translate(e.component);
  for (Blocker& b : e.blockers) translate(b.component);
  for (ComponentId& c : e.together) translate(c);
  for (ComponentId& c : e.locked) translate(c);
  return e;
}

Finding finding_of(const Search& search, const Plan& plan) {
  const Standing& standing = *search.standing;
  Finding finding;
  finding.kind = search.kind;
  finding.standing = search.standing;
  finding.complete = plan.complete();
  finding.out_of_time = plan.out_of_time;
  finding.seconds = plan.seconds;
  finding.steps = plan.steps.size();
  for (const Explanation& reason : plan.staying) finding.reasons.push_back(translated(standing, reason));
  finding.path = plan_path(standing.assembly, standing.pairs, plan);
  if (search.kind == SearchKind::TakeOut && plan.complete())
    finding.removals = removals_of(standing, plan, finding.path);
  return finding;
}

}  // namespace

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

Standing assembled(const Session& session) {
  Standing all{session.assembly(), session.pairs(), {}, {}};
  for (std::uint32_t c = 0; c < all.assembly.components.size(); ++c) all.components.emplace_back(c);
  all.poses.resize(all.components.size());
  return all;
}

Standing standing(const Session& session) {
  Standing some{session.assembly(), {}, {}, {}};
  some.assembly.components.clear();
  for (std::uint32_t c = 0; c < session.poses().size(); ++c) {
    if (session.is_removed(ComponentId(c))) continue;
    some.components.emplace_back(c);
    some.poses.push_back(session.poses()[c]);
    Component moved = session.assembly().components[c];
    moved.assembly_from_mesh = transform_from_pose(some.poses.back()) * moved.assembly_from_mesh;
    some.assembly.components.push_back(std::move(moved));
  }
  some.pairs = pairs_of(some, session.pairs(), session.engine().embedded_pairs());
  return some;
}

bool still_stands(const Standing& standing, const Session& session) {
  std::size_t next = 0;
  for (std::uint32_t c = 0; c < session.poses().size(); ++c) {
    if (session.is_removed(ComponentId(c))) continue;
    if (next == standing.components.size() || standing.components[next] != ComponentId(c) ||
        !(standing.poses[next] == session.poses()[c]))
      return false;
    ++next;
  }
  return next == standing.components.size();
}

std::string search_name(const Search& search) {
  if (search.targets.empty()) return "Planning " + search.standing->assembly.source_file;
  std::string names = names_of(search.standing->assembly, local(*search.standing, search.targets));
  switch (search.kind) {
    case SearchKind::Plan:
      return "Planning the removal of " + names;
    case SearchKind::TakeOut:
      return "Path for " + names;
    case SearchKind::Why:
      return "Why " + names + " stays";
  }
  return names;
}

Result<Finding> run_search(const Search& search, const ProgressCallback& progress) {
  bool cancelled = false;
  const ProgressCallback watched = [&](std::string_view stage, double fraction) {
    cancelled |= !report_progress(progress, stage, fraction);
    return !cancelled;
  };
  const Standing& standing = *search.standing;
  Finding finding;
  if (search.kind == SearchKind::Why) {
    finding.kind = search.kind;
    finding.standing = search.standing;
    const PlanOptions options = plan_options(search, watched);
    finding.reasons.push_back(
        translated(standing, why_blocked(standing.assembly, standing.pairs, options.targets[0], options.engine)));
  } else {
    finding = finding_of(search, plan_disassembly(standing.assembly, standing.pairs, plan_options(search, watched)));
  }
  if (!report_progress(watched, "planning", 1)) return Error{ErrorKind::Failed, "cancelled"};
  return finding;
}

Json search_json(const Finding& finding) {
  Json reasons = Json::array();
  for (const Explanation& e : finding.reasons) {
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
  return {{"kind", name_of(finding.kind)}, {"complete", finding.complete}, {"out_of_time", finding.out_of_time},
          {"seconds", finding.seconds},    {"steps", finding.steps},       {"reasons", std::move(reasons)}};
}

}  // namespace dismantle::server
