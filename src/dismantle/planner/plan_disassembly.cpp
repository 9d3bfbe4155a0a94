// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/plan_disassembly.h"

#include "dismantle/core/contract.h"
#include "dismantle/features/revolution_axes.h"
#include "dismantle/planner/explanation.h"
#include "dismantle/planner/search/candidate_directions.h"
#include "dismantle/planner/search/removal_search.h"
#include "dismantle/planner/search/sample_search.h"
#include "dismantle/planner/search/screw_search.h"
#include "dismantle/planner/search/slide_search.h"
#include "dismantle/planner/search/motion_validator.h"
#include "dismantle/planner/step_preference.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <map>
#include <optional>

namespace dismantle {

namespace {

using Clock = std::chrono::steady_clock;

/// So many of the directions that most components share are tried with all of them.
constexpr std::size_t kShared = 8;
/// How much less each next one of a component's directions counts for that.
constexpr double kRankWeight = 0.9;
/// A sliding component is pushed along so many of its directions and turned about so many axes at most.
constexpr std::size_t kMaxPushes = 12;
constexpr std::size_t kMaxTurns = 4;
/// The search for a way that is not straight may cost so much for each component, little for all of them first.
constexpr std::size_t kFirstEffort = 40'000, kEffortGrowth = 4;
/// A longer search that gets no further than so many times as far as the one before is the last one.
constexpr double kFurther = 1.1;
/// What got no further than this [radii] in shorter searches rattles in its seat: no longer one is made at random.
constexpr double kRoom = 0.5;
/// Components are as large as each other where they differ by less: by rounding in a turned assembly.
constexpr double kSameSize = 1e-6;
/// What was taken away stands so many diameters of the assembly off.
constexpr double kFarAway = 100;

std::vector<ShapeFeatures> features_of(const Assembly& assembly, const Executor& executor) {
  std::vector<ShapeFeatures> features(assembly.components.size());
  executor.for_each_heavy(features.size(),
                          [&](std::size_t c) { features[c] = shape_features(assembled_mesh(assembly.components[c])); });
  return features;
}

/// What is known of an assembly while its plan is made.
class Planner {
 public:
  Planner(const Assembly& assembly, const PairStates& pairs, const PlanOptions& options)
      : assembly_(assembly),
        options_(options),
        count_(assembly.components.size()),
        features_(features_of(assembly, options.engine.executor)),
        validator_(assembly, pairs, options.engine, kFarAway * diagonal(assembled_bounds(assembly)),
               [this] { return keep_going(); }),
        table_(validator_.engine(), features_, [this] { return in_time(); }),
        directions_(count_),
        tolerance_(pairs.tolerance),
        contacts_(count_),
        threads_(count_),
        modelled_(count_),
        revolution_axes_(count_),
        sliding_{options.slide_effort, 0, {}},
        sampling_{options.sample_effort, 0, {}} {
    find_directions(pairs.tolerance);
  }

  Plan run() {
    const ComponentSet all = ComponentSet::all(count_);
    if (options_.targets.empty()) {
      take_apart(all, PlanStep::kWhole);
    } else {
      take_out(all, options_.targets, PlanStep::kWhole);
    }
    plan_.out_of_time = stopped_;
    plan_.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    return std::move(plan_);
  }

  Explanation explain_assembled(ComponentId component) {
    return explain(table_, component, directions_[component.value], ComponentSet::all(count_));
  }

 private:
  /// False once the user or the clock says so.
  bool keep_going() {
    const double done = static_cast<double>(taken_out_) / static_cast<double>(std::max<std::size_t>(1, count_));
    if (!stopped_ && !report_progress(options_.progress, "planning", done)) stopped_ = true;
    return in_time();
  }
  /// The same, by the clock only: for any thread.
  bool in_time() {
    const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
    if (options_.time_limit > 0 && elapsed > options_.time_limit) stopped_ = true;
    return !stopped_;
  }

  /// The components of a body that stay where they are while it is taken apart: the fixed ones, or the largest.
  ComponentSet staying_of(const ComponentSet& body) const {
    ComponentSet staying(count_);
    for (const ComponentId c : options_.fixed)
      if (body.has(c)) staying.insert(c);
    if (staying.size() > 0) return staying;
    const std::vector<ComponentId> members = body.members();
    double largest = 0;
    for (const ComponentId c : members) largest = std::max(largest, features_[c.value].area);
    staying.insert(*std::find_if(members.begin(), members.end(),
                                 [&](ComponentId c) { return features_[c.value].area >= (1 - kSameSize) * largest; }));
    return staying;
  }

  /// Takes everything out of a body that can be, and apart what comes out as one.
  void take_apart(const ComponentSet& body, std::uint32_t part_of) {
    const ComponentSet left = take_away(body, staying_of(body), part_of);
    explain_left(left, staying_of(left));
  }

  /// Takes the targets out of a body with as few others as possible; where straight ways do not do, by themselves.
  void take_out(const ComponentSet& body, const std::vector<ComponentId>& targets, std::uint32_t part_of) {
    const ComponentSet never(count_, options_.fixed);
    const KeepGoing ask = [this] { return keep_going(); };
    ComponentSet left = body;
    for (;;) {
      const auto needed = fewest_removals(table_, directions_, body, never, targets, ask);
      ComponentSet staying = body;
      staying.erase(needed ? needed->members() : targets);
      const std::size_t steps = plan_.steps.size();
      left = take_away(body, staying, part_of);
      if (!needed || !left.has_any(targets) || stopped_) break;
      // The engine refused a step: what it said is known now.
      plan_.steps.resize(steps);
    }
    for (const ComponentId target : targets)
      if (left.has(target) && keep_going())
        plan_.staying.push_back(explain(table_, target, directions_[target.value], left));
  }

  /// Takes what it can out of `body` but for `staying`. @return what is left
  ComponentSet take_away(ComponentSet body, const ComponentSet& staying, std::uint32_t part_of) {
    while (body.size() > staying.size() && keep_going()) {
      validator_.stand(body);
      const std::optional<PlanStep> step = next_step(body, staying);
      if (!step) break;
      body.erase(step->components);
      const auto index = static_cast<std::uint32_t>(plan_.steps.size());
      plan_.steps.push_back(*step);
      plan_.steps.back().part_of = part_of;
      taken_out_ += step->components.size() == 1 ? 1 : 0;
      if (step->components.size() > 1) go_into(*step, index);
    }
    return body;
  }

  /// Goes on with what a step took away as one body: as far as it was asked for.
  void go_into(const PlanStep& step, std::uint32_t index) {
    const ComponentSet body(count_, step.components);
    std::vector<ComponentId> targets = options_.targets;
    std::erase_if(targets, [&](ComponentId c) { return !body.has(c); });
    if (options_.targets.empty() || targets.size() == body.size()) {
      take_apart(body, index);
    } else if (!targets.empty()) {
      take_out(body, targets, index);
    }
  }

  std::optional<PlanStep> next_step(const ComponentSet& body, const ComponentSet& staying) {
    const std::vector<StraightRemoval> single = single_removals(body, staying);
    for (const StraightRemoval& removal : single)
      if (auto step = try_removal(removal, body)) return step;
    if (!single.empty()) return keep_going() ? next_step(body, staying) : std::nullopt;
    if (auto step = find_screwed(body, staying)) return step;
    const auto ask = [this] { return keep_going(); };
    while (const auto removal = smallest_body(table_, directions_, body, staying, ask))
      if (auto step = try_removal(*removal, body)) return step;
    if (auto step = find_sliding(body, staying)) return step;
    return find_sampled(body, staying);
  }

  /// One component that is screwed out, the smallest first.
  std::optional<PlanStep> find_screwed(const ComponentSet& body, const ComponentSet& staying) {
    for (const ComponentId c : smallest_first(body, staying)) {
      for (const auto& [neighbour, thread] : threads_of(c)) {
        if (!keep_going()) return std::nullopt;
        if (!body.has(neighbour)) continue;
        std::vector<ComponentId>& met = met_[{c, neighbour}];
        if (!met.empty() && body.has_all(met)) continue;
        PathSearch search = screw_out(validator_, table_, c, thread, [this] { return keep_going(); });
        if (search.step) return std::move(search.step);
        met = std::move(search.met);
      }
    }
    return std::nullopt;
  }

  /// Searches that cost a lot, and what they found out.
  struct LongSearches {
    struct InVain {
      std::size_t effort = 0;
      std::vector<ComponentId> met;
      std::optional<double> furthest;  // see PathSearch
    };
    std::size_t most;                       ///< That all of them may cost,
    std::size_t spent = 0;                  ///< and have cost.
    std::map<ComponentId, InVain> in_vain;  ///< As long as what a component met is there, no less effort helps it.
  };

  /// One component that `search` finds a way out for, the smallest first; the longer one is searched for, the fewer
  /// have come out.
  /// @param search (component, effort) -> PathSearch
  template <class Search>
  std::optional<PlanStep> search_by_effort(const ComponentSet& body, const ComponentSet& staying, LongSearches& searches,
                                    const Search& search) {
    for (std::size_t effort = kFirstEffort; effort < kEffortGrowth * searches.most; effort *= kEffortGrowth)
      for (const ComponentId c : smallest_first(body, staying)) {
        LongSearches::InVain& before = searches.in_vain[c];
        if (before.effort >= effort && body.has_all(before.met)) continue;
        const std::size_t left = searches.most - std::min(searches.spent, searches.most);
        if (left == 0 || !keep_going()) return std::nullopt;
        const std::size_t begun = validator_.effort();
        PathSearch found = search(c, std::min(effort, left));
        searches.spent += validator_.effort() - begun;
        if (found.step) return std::move(found.step);
        const bool no_further =
            before.effort > 0 && body.has_all(before.met) && found.furthest <= kFurther * before.furthest.value_or(0);
        before = {found.exhausted || no_further ? std::numeric_limits<std::size_t>::max() : effort,
                  std::move(found.met), found.furthest};
      }
    return std::nullopt;
  }

  std::optional<PlanStep> find_sliding(const ComponentSet& body, const ComponentSet& staying) {
    return search_by_effort(body, staying, sliding_, [&](ComponentId c, std::size_t effort) {
      SlideMoves moves = slide_moves(c, body);
      moves.max_effort = effort;
      return slide_out(validator_, table_, c, moves, [this] { return keep_going(); });
    });
  }

  std::optional<PlanStep> find_sampled(const ComponentSet& body, const ComponentSet& staying) {
    return search_by_effort(body, staying, sampling_, [&](ComponentId c, std::size_t effort) {
      const LongSearches::InVain& slid = sliding_.in_vain[c];
      const double room = std::max(slid.furthest.value_or(0), sampling_.in_vain[c].furthest.value_or(0));
      const bool held_fast = slid.effort > 0 && !slid.furthest, rattles = effort > kFirstEffort && room < kRoom;
      if (held_fast || rattles) return PathSearch{std::nullopt, slid.met, slid.furthest, true};
      return sample_out(validator_, table_, c, effort, [this] { return keep_going(); });
    });
  }

  /// The directions of a component, and the axes that it or what is about it is round about.
  SlideMoves slide_moves(ComponentId c, const ComponentSet& body) {
    SlideMoves moves;
    for (const DirectionId d : directions_[c.value])
      if (moves.directions.size() < kMaxPushes) moves.directions.push_back(table_.direction(d));
    const auto add = [&](const RevolutionAxis& axis) {
      const auto same = [&](const TurnAxis& known) {
        return length(cross(known.direction, axis.direction)) < kSameDirectionAngle &&
               length(cross(axis.direction, known.point - axis.point)) <
                   kSameDirectionAngle * features_[c.value].radius;
      };
      if (moves.axes.size() < kMaxTurns && std::none_of(moves.axes.begin(), moves.axes.end(), same))
        moves.axes.push_back({axis.point, axis.direction});
    };
    for (const RevolutionAxis& axis : revolution_axes_of(c)) add(axis);
    for (const ComponentId near : contacts_[c.value].neighbours)
      if (body.has(near))
        for (const RevolutionAxis& axis : revolution_axes_of(near)) add(axis);
    for (const WeightedDirection& axis : features_[c.value].axes) add({features_[c.value].center, axis.direction, 0});
    return moves;
  }

  const std::vector<RevolutionAxis>& revolution_axes_of(ComponentId c) {
    std::optional<std::vector<RevolutionAxis>>& known = revolution_axes_[c.value];
    if (!known) {
      const TriangleMesh mesh = assembled_mesh(assembly_[c]);
      known = revolution_axes(mesh.vertices, mesh.faces);
    }
    return *known;
  }

  std::vector<ComponentId> smallest_first(const ComponentSet& body, const ComponentSet& staying) const {
    std::vector<ComponentId> members = body.members();
    std::erase_if(members, [&](ComponentId c) { return staying.has(c); });
    std::stable_sort(members.begin(), members.end(), [this](ComponentId a, ComponentId b) {
      return features_[a.value].radius < features_[b.value].radius;
    });
    return members;
  }

  /// The threads that a component shares with others: those that both are modelled with, or else those that their
  /// faces tell.
  const std::vector<NeighbourThread>& threads_of(ComponentId c) {
    std::optional<std::vector<NeighbourThread>>& known = threads_[c.value];
    if (known) return *known;
    known.emplace();
    for (const ComponentId other : neighbours_of(c))
      for (const ThreadAxis& thread : modelled_threads(c))
        for (const ThreadAxis& its : modelled_threads(other))
          if (threads_mate(thread, its)) known->push_back({other, thread});
    if (known->empty()) known = touched_threads(assembly_, validator_.hold(c), features_[c.value].radius, tolerance_);
    return *known;
  }

  /// All the others that may be within its sphere.
  std::vector<ComponentId> neighbours_of(ComponentId c) const {
    std::vector<ComponentId> near;
    for (std::uint32_t k = 0; k < count_; ++k)
      if (k != c.value &&
          length(features_[k].center - features_[c.value].center) < features_[k].radius + features_[c.value].radius)
        near.emplace_back(k);
    return near;
  }

  const std::vector<ThreadAxis>& modelled_threads(ComponentId c) {
    std::optional<std::vector<ThreadAxis>>& known = modelled_[c.value];
    if (!known) {
      const TriangleMesh mesh = assembled_mesh(assembly_[c]);
      known = thread_axes(mesh.vertices, mesh.faces, revolution_axes_of(c));
    }
    return *known;
  }

  /// Components that can go straight out by themselves, those to be tried first in front.
  std::vector<StraightRemoval> single_removals(const ComponentSet& body, const ComponentSet& staying) {
    if (!options_.preferences.empty()) {
      if (kinds_.empty()) kinds_ = component_kinds(assembly_);
      StepBefore before;
      if (!plan_.steps.empty()) before = {plan_.steps.back().components.front(), plan_.steps.back().exit};
      return preferred_removals({table_, directions_, kinds_, options_.preferences}, body, staying, before);
    }
    std::vector<StraightRemoval> single =
        free_components(table_, directions_, body, staying, options_.engine.executor, [this] { return in_time(); });
    std::stable_sort(single.begin(), single.end(), [this](const StraightRemoval& a, const StraightRemoval& b) {
      const bool a_goes_on = a.direction == last_direction_, b_goes_on = b.direction == last_direction_;
      if (a_goes_on != b_goes_on) return a_goes_on;
      return features_[a.components[0].value].radius < features_[b.components[0].value].radius;
    });
    return single;
  }

  /// Tries it with the engine, and learns from it where that refuses.
  std::optional<PlanStep> try_removal(const StraightRemoval& removal, const ComponentSet& body) {
    const Vec3 direction = table_.direction(removal.direction);
    double way = 0;
    for (const ComponentId c : removal.components) way = std::max(way, table_.exit_distance(c, removal.direction));
    const MotionValidator::Trial trial = validator_.try_straight(removal.components, direction, way);
    if (trial.free) {
      last_direction_ = removal.direction;
      const PlanTier tier = removal.components.size() == 1 ? PlanTier::Straight : PlanTier::StraightTogether;
      return PlanStep{removal.components, tier, PlanStep::kWhole, {}, direction};
    }
    for (const auto& [moving, fixed] : trial.against) table_.add_blocker(moving, removal.direction, fixed);
    if (!trial.against.empty()) return std::nullopt;
    // No pair of components is known to be against it; whatever it is, this way is closed.
    for (const ComponentId c : removal.components)
      for (const ComponentId other : body.members())
        if (std::find(removal.components.begin(), removal.components.end(), other) == removal.components.end())
          table_.add_blocker(c, removal.direction, other);
    return std::nullopt;
  }

  /// Gives every component its directions: those that open what it touches, those that many components share (fewer
  /// turns of the assembly), and the rest of its own.
  void find_directions(double tolerance) {
    std::vector<double> popularity;  // of every direction
    std::vector<std::vector<CandidateDirection>> own(count_);
    // What stays needs none; where there are targets, all but these may have to make way.
    const ComponentSet all = ComponentSet::all(count_), none(count_);
    const ComponentSet staying = options_.targets.empty() && count_ > 0 ? staying_of(all) : none;
    for (std::uint32_t c = 0; c < count_ && keep_going(); ++c) {
      const ComponentId id(c);
      if (!staying.has(id)) {
        contacts_[c] = contact_normals(assembly_, validator_.hold(id), features_[c].radius, tolerance);
        own[c] = candidate_directions(id, contacts_[c], features_);
      }
      double weight = 1;
      const auto vote = [&](const Vec3& direction) {
        const std::size_t index = table_.add_direction(direction).value;
        if (popularity.size() <= index) popularity.resize(index + 1);
        popularity[index] += weight;
      };
      for (const CandidateDirection& d : own[c]) {
        vote(d.direction);
        weight *= kRankWeight;
      }
      // What is against its contacts now is not once its neighbours are gone: the faces of a product that is built up
      // in layers say where these go.
      weight = 1;
      for (const WeightedDirection& normal : features_[c].normals) {
        vote(normal.direction);
        vote(-normal.direction);
        weight *= kRankWeight;
      }
    }
    const std::vector<DirectionId> shared = most_popular(popularity);
    for (std::uint32_t c = 0; c < count_; ++c) directions_[c] = in_order(own[c], shared);
    table_.expect_blockers(
        [this](ComponentId c, const Vec3& direction) { return neighbours_against(contacts_[c.value], direction); });
  }

  /// A component's own directions and the shared ones, all but the same ones once: what it has of its own is exact.
  std::vector<DirectionId> in_order(const std::vector<CandidateDirection>& own,
                                    const std::vector<DirectionId>& shared) {
    std::vector<DirectionId> list, rest;
    for (const CandidateDirection& d : own) (d.opens ? list : rest).push_back(table_.add_direction(d.direction));
    const auto add = [&](DirectionId d) {
      if (!one_along(list, d).valid()) list.push_back(d);
    };
    for (const DirectionId d : shared) {
      const DirectionId exact = one_along(rest, d);
      add(exact.valid() ? exact : d);
    }
    for (const DirectionId d : rest) add(d);
    return list;
  }

  /// The one of `list` that is all but the same as `d`; invalid where there is none.
  DirectionId one_along(const std::vector<DirectionId>& list, DirectionId d) const {
    const auto found = std::find_if(list.begin(), list.end(), [&](DirectionId known) {
      return length(table_.direction(known) - table_.direction(d)) < kSameDirectionAngle;
    });
    return found == list.end() ? DirectionId() : *found;
  }

  /// The directions that count most; of those that are all but the same, one.
  std::vector<DirectionId> most_popular(const std::vector<double>& popularity) const {
    std::vector<DirectionId> order, shared;
    for (std::uint32_t d = 0; d < popularity.size(); ++d) order.emplace_back(d);
    std::stable_sort(order.begin(), order.end(),
                     [&](DirectionId a, DirectionId b) { return popularity[a.value] > popularity[b.value]; });
    for (const DirectionId d : order)
      if (shared.size() < kShared && !one_along(shared, d).valid()) shared.push_back(d);
    return shared;
  }

  void explain_left(const ComponentSet& left, const ComponentSet& staying) {
    for (const ComponentId c : left.members())
      if (!staying.has(c) && keep_going()) plan_.staying.push_back(explain(table_, c, directions_[c.value], left));
  }

  const Assembly& assembly_;
  const PlanOptions& options_;
  std::size_t count_;
  Clock::time_point start_ = Clock::now();
  std::atomic<bool> stopped_ = false;
  std::size_t taken_out_ = 0;
  std::vector<ShapeFeatures> features_;
  MotionValidator validator_;
  BlockingTable table_;
  DirectionLists directions_;
  double tolerance_;
  std::vector<ContactNormals> contacts_;
  DirectionId last_direction_;
  std::vector<std::uint32_t> kinds_;  // of components, where preferences ask for them
  // Of every component, once they are asked for.
  std::vector<std::optional<std::vector<NeighbourThread>>> threads_;
  std::vector<std::optional<std::vector<ThreadAxis>>> modelled_;
  std::vector<std::optional<std::vector<RevolutionAxis>>> revolution_axes_;
  LongSearches sliding_, sampling_;
  std::map<std::pair<ComponentId, ComponentId>, std::vector<ComponentId>> met_;  // by those screwed apart in vain
  Plan plan_;
};

}  // namespace

Plan plan_disassembly(const Assembly& assembly, const PairStates& pairs, const PlanOptions& options) {
  return Planner(assembly, pairs, options).run();
}

Explanation why_blocked(const Assembly& assembly, const PairStates& pairs, ComponentId component,
                        const CertificateOptions& options) {
  DISMANTLE_EXPECT(component.value < assembly.components.size());
  PlanOptions plan;
  plan.targets = {component};
  plan.engine = options;
  return Planner(assembly, pairs, plan).explain_assembled(component);
}

}  // namespace dismantle
