// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/plan_disassembly.h"

#include "dismantle/core/contract.h"
#include "dismantle/fasteners/find_fasteners.h"
#include "dismantle/files/number_text.h"
#include "dismantle/joints/find_joints.h"
#include "dismantle/planner/explanation.h"
#include "dismantle/planner/joint_relations.h"
#include "dismantle/planner/joint_steps.h"
#include "dismantle/planner/least_overlap.h"
#include "dismantle/planner/order/enclosed_steps.h"
#include "dismantle/planner/order/plan_order.h"
#include "dismantle/planner/plan_time.h"
#include "dismantle/planner/search/curved_steps.h"
#include "dismantle/planner/search/direction_choice.h"
#include "dismantle/planner/search/fixed_components.h"
#include "dismantle/planner/search/motion_validator.h"
#include "dismantle/planner/search/removal_search.h"
#include "dismantle/planner/search/single_removals.h"
#include "dismantle/planner/step_preference.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <utility>

namespace dismantle {

namespace {

/// CertificateOptions::depth_tests of a step: about half a second.
constexpr std::size_t kDepthTests = 50000;
/// Distance at which removed components stand, in diagonals of the assembly.
constexpr double kFarAway = 100;

/// The groups that the options name, and one for each lock nut with its insert.
RigidGroups groups_of(const Assembly& assembly, const PlanOptions& options, const std::vector<Joint>& joints) {
  RigidGroups groups(assembly.components.size());
  for (const std::vector<ComponentId>& together : options.together) groups.unite(together);
  for (const Joint& joint : joints)
    for (const auto& [insert, nut] : joint.nut_inserts) groups.unite(std::vector{insert, nut});
  return groups;
}

std::vector<std::optional<Fastener>> fasteners_of(const Assembly& assembly, const PlanOptions& options) {
  if (options.fasteners == FastenerOrder::Ignored) return {};
  return find_fasteners(assembly, options.engine.executor);
}

/// Makes one plan of one assembly.
class Planner {
 public:
  Planner(const Assembly& assembly, const PairStates& pairs, const PlanOptions& options)
      : options_(options),
        count_(assembly.components.size()),
        time_(options.time_limit),
        fasteners_(fasteners_of(assembly, options)),
        joints_(fasteners_.empty() ? std::vector<Joint>{} : find_joints(assembly, fasteners_, options.engine.executor)),
        groups_(groups_of(assembly, options, joints_)),
        targets_(groups_.with_groups(options.targets)),
        fixed_(groups_.with_groups(options.fixed)),
        features_(shape_features(assembly, options.engine.executor)),
        planned_{assembly, features_, pairs.tolerance},
        relations_(joints_, groups_, count_),
        validator_(assembly, pairs, engine_options(), groups_, kFarAway * diagonal(assembled_bounds(assembly)),
                   [this] { return keep_going(); }),
        table_(validator_.engine(), features_, groups_, time_left_),
        choice_(planned_, table_, validator_.engine(), without_directions(), options.engine.executor,
                [this] { return keep_going(); }),
        joint_steps_(relations_, table_, choice_, groups_),
        single_({assembly, features_, relations_, table_, choice_, joint_steps_, options, time_left_}),
        curved_(planned_, {groups_, features_, validator_, table_, choice_, keep_going_}, options.slide_effort,
                options.sample_effort),
        overlaps_(assembly, pairs, table_, engine_options()) {
    plan_.allowances = validator_.engine().overlapping_pairs();
    for (const FlexiblePart& part : options.flexible)
      for (const ComponentPair& pair : pairs.pairs)
        if (length_squared(part.axis) > 0 && pair.declared > 0 &&
            (pair.a == part.component || pair.b == part.component))
          table_.let_pass_along(pair.a, pair.b, part.axis);
    for (std::uint32_t c = 0; c < count_; ++c) {
      if (!relations_.is_fastener(ComponentId(c))) continue;
      for (const Vec3& exit : relations_.exits_of(ComponentId(c))) choice_.put_first(ComponentId(c), exit);
    }
  }

  Plan run() {
    const ComponentSet all = ComponentSet::all(count_);
    if (targets_.empty()) {
      bodies_.push_back({all, staying_of(all), PlanStep::kWhole});
    } else {
      take_out(all, targets_, PlanStep::kWhole);
    }
    take_apart_bodies();
    plan_.joints = joints_;
    time_.begin_order();
    plan_ = in_good_order(plan_, {planned_, fasteners_, relations_, table_, validator_,
                                  order_weights(options_.preferences, options_.preference_weights),
                                  options_.engine.executor, keep_going_, describe_});
    find_enclosed_steps(planned_, fasteners_, keep_going_, plan_);
    if (!options_.wants_reasons || options_.wants_reasons(plan_)) {
      explain_left();
    } else {
      for (const auto& [left, present] : left_) {
        const Span<const ComponentId> group = groups_.of(left);
        plan_.staying.push_back({left, {group.begin(), group.end()}, {}, {}, {}, {}, {}});
      }
    }
    plan_.out_of_time = time_.has_run_out();
    plan_.effort_spent = !plan_.out_of_time && curved_.may_find_more(plan_.staying);
    plan_.seconds = time_.seconds();
    return std::move(plan_);
  }
  Explanation explain_assembled(ComponentId component) {
    time_.begin_reasons();
    const ComponentSet all = ComponentSet::all(count_);
    std::vector<Explanation> found{explained(component, all)};
    add_overlaps(found, {all});
    return std::move(found.front());
  }

 private:
  CertificateOptions engine_options() {
    CertificateOptions options = options_.engine;
    options.keep_going = [this] { return time_.is_left(); };
    if (options.depth_tests == 0) options.depth_tests = kDepthTests;
    return options;
  }

  /// The components that need no directions of their own: those that stay. With targets, any other may have to move.
  ComponentSet without_directions() const {
    if (!targets_.empty() || count_ == 0) return ComponentSet(count_);
    return staying_of(ComponentSet::all(count_));
  }

  /// False once the user or the time limit ends the search; thread-safe.
  bool keep_going() {
    const std::lock_guard lock(progress_mutex_);
    const std::string found = plan_.steps.empty() ? "" : ", " + count_text(plan_.steps.size(), "step") + " found";
    const double share = static_cast<double>(taken_out_) / static_cast<double>(std::max<std::size_t>(1, count_));
    if (!time_.is_over() && !report_progress(options_.progress, "planning" + found, share)) time_.cancel();
    return time_.is_left();
  }

  ComponentSet staying_of(const ComponentSet& body) const { return fixed_components(body, fixed_, features_, groups_); }

  /// The searches that a plan makes for the next step.
  enum class Effort {
    Simple,  ///< Straight motions and threads.
    Any,     ///< Sliding and random motions as well, which may take long.
  };

  /// Removes everything that can be removed from the bodies to be taken apart, and from those that are removed in one
  /// piece meanwhile. Long searches in one of them wait until no simple step is left in any.
  void take_apart_bodies() {
    for (const Effort effort : {Effort::Simple, Effort::Any})
      for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Body body = bodies_[i];
        ComponentSet left = take_away(body.left, body.staying, body.part_of, effort);
        bodies_[i].left = std::move(left);
      }
    for (const Body& body : bodies_) {
      const ComponentSet staying = staying_of(body.left);
      for (const ComponentId c : body.left.members())
        if (!staying.has(c) && table_.leader_of(c) == c) left_.emplace_back(c, body.left);
    }
  }

  /// Removes the targets from a body with as few others as possible; if straight motions are not enough, by themselves.
  void take_out(const ComponentSet& body, const std::vector<ComponentId>& targets, std::uint32_t part_of) {
    const ComponentSet never(count_, fixed_);
    ComponentSet left = body;
    std::vector<PlanStep> given_up;  // of the longest attempt
    for (;;) {
      const auto needed = needed_for(targets, body, never);
      ComponentSet staying = body;
      staying.erase(needed ? needed->members() : targets);
      const std::size_t steps = plan_.steps.size(), bodies = bodies_.size(), taken_out = taken_out_;
      left = take_away(body, staying, part_of, Effort::Any);
      std::vector<PlanStep> found(plan_.steps.begin() + static_cast<std::ptrdiff_t>(steps), plan_.steps.end());
      if (found.size() > given_up.size()) given_up = std::move(found);
      if (!left.has_any(targets) || (!needed && !time_.is_over())) break;
      plan_.steps.resize(steps);
      if (time_.is_over()) {  // what was found must not get less because the search was ended
        plan_.steps.insert(plan_.steps.end(), given_up.begin(), given_up.end());
        break;
      }
      // The engine refused a step; the table knows the reason now.
      taken_out_ = taken_out;
      bodies_.erase(bodies_.begin() + static_cast<std::ptrdiff_t>(bodies), bodies_.end());
    }
    for (const ComponentId target : targets)
      if (left.has(target) && table_.leader_of(target) == target) left_.emplace_back(target, left);
  }

  /// The components that have to go for the targets: with the fasteners that hold them, if there is a way.
  std::optional<ComponentSet> needed_for(const std::vector<ComponentId>& targets, const ComponentSet& body,
                                         const ComponentSet& never) {
    std::optional<ComponentSet> needed;
    if (!relations_.empty()) {
      table_.follow(&relations_);
      needed = fewest_removals(table_, choice_.directions(), body, never, targets, keep_going_);
      table_.follow(nullptr);
    }
    return needed ? needed : fewest_removals(table_, choice_.directions(), body, never, targets, keep_going_);
  }

  /// Removes what it can from `body` except `staying`. @return the rest
  ComponentSet take_away(ComponentSet body, const ComponentSet& staying, std::uint32_t part_of, Effort effort) {
    BodySearches searches = single_.searches_in(body, staying);
    while (body.size() > staying.size() && keep_going()) {
      validator_.stand(body);
      std::optional<PlanStep> step = next_step(body, staying, effort, searches);
      if (!step) break;
      describe_(*step, body);
      body.erase(step->components);
      searches.remove(step->components);
      const auto index = static_cast<std::uint32_t>(plan_.steps.size());
      plan_.steps.push_back(*step);
      plan_.steps.back().part_of = part_of;
      const std::size_t group = groups_.of(step->components.front()).size();
      if (step->components.size() == group || relations_.fastener_of(step->components).valid()) {
        taken_out_ += step->components.size();
      } else {
        go_into(*step, index);
      }
    }
    return body;
  }

  /// Has the body that a step removed taken apart, as far as required.
  void go_into(const PlanStep& step, std::uint32_t index) {
    const ComponentSet body(count_, step.components);
    std::vector<ComponentId> targets = targets_;
    std::erase_if(targets, [&](ComponentId c) { return !body.has(c); });
    if (targets_.empty() || targets.size() == body.size()) {
      bodies_.push_back({body, staying_of(body), index});
    } else if (!targets.empty()) {
      take_out(body, targets, index);
    }
  }

  std::optional<PlanStep> next_step(const ComponentSet& body, const ComponentSet& staying, Effort effort,
                                    BodySearches& searches) {
    if (!relations_.empty()) {
      table_.follow(&relations_);
      auto step = simple_step(body, staying, searches, &relations_);
      table_.follow(nullptr);
      if (step) return step;
    }
    if (auto step = simple_step(body, staying, searches, nullptr)) return step;
    if (effort == Effort::Simple) return std::nullopt;
    if (auto step = curved_.find_sliding(body, staying)) return step;
    return curved_.find_sampled(body, staying);
  }

  /// A step straight or along a thread. @param joints those that the step respects; may be null
  std::optional<PlanStep> simple_step(const ComponentSet& body, const ComponentSet& staying, BodySearches& searches,
                                      const JointRelations* joints) {
    const auto single_step = [&](SingleRemovals::Among among) -> std::optional<PlanStep> {
      for (bool any = true; any && keep_going();) {
        const SingleRemovals::Before before{plan_.steps.empty() ? nullptr : &plan_.steps.back(), last_direction_};
        const std::vector<StraightRemoval> single = single_.find(body, staying, searches, joints, among, before);
        for (const StraightRemoval& removal : single)
          if (auto step =
                  try_removal(joints != nullptr ? joint_steps_.with_washers(removal, body, staying) : removal, body))
            return step;
        any = !single.empty();
      }
      return std::nullopt;
    };
    table_.postpone_hard(true);
    std::optional<PlanStep> easy = single_step(SingleRemovals::Among::Reachable);
    if (!easy) easy = curved_.find_screwed(body, staying, CurvedSteps::Groups::Single, joints);
    if (!easy) easy = single_step(SingleRemovals::Among::All);
    table_.postpone_hard(false);
    if (easy) return easy;
    searches.retry_postponed();
    if (auto step = single_step(SingleRemovals::Among::All)) return step;
    while (const auto removal =
               smallest_body(table_, choice_.directions(), body, staying, options_.engine.executor, keep_going_))
      if (auto step = try_removal(*removal, body)) return step;
    return curved_.find_screwed(body, staying, CurvedSteps::Groups::OfSeveral, joints);
  }

  /// Validates a removal with the engine, and records the blockers if it fails.
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
    // No pair of components is known to block; the direction is closed whatever the reason.
    for (const ComponentId c : removal.components)
      for (const ComponentId other : body.members())
        if (std::find(removal.components.begin(), removal.components.end(), other) == removal.components.end())
          table_.add_blocker(c, removal.direction, other);
    return std::nullopt;
  }

  /// Adds by how much a component would have to overlap to come out; several are searched for side by side.
  /// @param present with each of the reasons
  void add_overlaps(std::vector<Explanation>& reasons, const std::vector<ComponentSet>& present) {
    if (!(options_.overlap_limit > 0)) return;
    std::vector<std::vector<OverlapSearch::Way>> ways(reasons.size());
    for (std::size_t i = 0; i < reasons.size() && keep_going(); ++i)
      if (const ComponentId c = reasons[i].component; !reasons[i].blockers.empty())
        ways[i] = overlaps_.ways_out(c, choice_.directions()[c.value], present[i]);
    options_.engine.executor.for_each_heavy(reasons.size(), [&](std::size_t i) {
      std::optional<LeastOverlap> found = overlaps_.find(ways[i], options_.overlap_limit, keep_going_);
      if (keep_going()) reasons[i].overlap = std::move(found);  // else it may rest on what was not tested
    });
  }

  Explanation explained(ComponentId component, const ComponentSet& present) {
    const Span<const DirectionId> directions = choice_.directions()[component.value];
    BlockedWay way = least_blocked_way(table_, component, directions, present, options_.engine.executor);
    return explain(table_, component, std::move(way), present);
  }

  /// Explains why components are left; what would have to be allowed for them, which takes longer, comes last.
  void explain_left() {
    time_.begin_reasons();
    std::vector<ComponentSet> present;
    for (const auto& [left, with] : left_) {
      Explanation reason = explained(left, with);
      if (!keep_going()) return;  // it may rest on relations that were not tested
      plan_.staying.push_back(std::move(reason));
      present.push_back(with);
    }
    add_overlaps(plan_.staying, present);
  }

  const PlanOptions& options_;
  std::size_t count_;
  ///@{ For keep_going(), which constructors of the members below call already.
  PlanTime time_;
  std::mutex progress_mutex_;
  std::size_t taken_out_ = 0;
  Plan plan_;
  ///@}
  const std::vector<std::optional<Fastener>> fasteners_;
  const std::vector<Joint> joints_;
  RigidGroups groups_;
  std::vector<ComponentId> targets_, fixed_;  // with their groups
  std::vector<ShapeFeatures> features_;
  PlannedAssembly planned_;
  const KeepGoing keep_going_ = [this] { return keep_going(); };
  const KeepGoing time_left_ = [this] { return time_.is_left(); };
  JointRelations relations_;
  MotionValidator validator_;
  BlockingTable table_;
  DirectionChoice choice_;
  JointSteps joint_steps_;
  SingleRemovals single_;
  CurvedSteps curved_;
  OverlapSearch overlaps_;
  /// Sets what depends on the body that a step takes something from.
  const std::function<void(PlanStep&, const ComponentSet&)> describe_ = [this](PlanStep& step,
                                                                               const ComponentSet& body) {
    step.unscrewing = relations_.unscrewing(step, body);
    step.still_held_by = relations_.torn_by(step, body);
  };
  DirectionId last_direction_;
  /// Components that are taken apart in one place.
  struct Body {
    ComponentSet left, staying;
    std::uint32_t part_of;
  };
  std::vector<Body> bodies_;
  std::vector<std::pair<ComponentId, ComponentSet>> left_;  // what was not removed, and from among what
};

}  // namespace

Plan plan_disassembly(const Assembly& assembly, const PairStates& pairs, const PlanOptions& options) {
  return Planner(assembly, pairs, options).run();
}

Explanation why_blocked(const Assembly& assembly, const PairStates& pairs, ComponentId component,
                        const PlanOptions& options) {
  DISMANTLE_EXPECT(component.value < assembly.components.size());
  PlanOptions plan = options;
  plan.targets = {component};
  plan.fixed.clear();
  plan.fasteners = FastenerOrder::Ignored;
  return Planner(assembly, pairs, plan).explain_assembled(component);
}

}  // namespace dismantle
