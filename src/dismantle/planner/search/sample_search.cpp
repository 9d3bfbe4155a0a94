// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/sample_search.h"

#include "dismantle/planner/search/search_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

namespace dismantle {

namespace {

constexpr double kHalfTurn = 3.14159265358979;
/// Configurations nearer than this share of the component's radius count as one.
constexpr double kSameConfiguration = 0.03;
/// Range of random poses around the assembled pose [radii].
constexpr double kRegion = 2.5;
/// Length of one motion [radii of the component].
constexpr double kReaches[] = {0.06, 0.25, 1};
/// A straight exit is tried from a node that is further out than all before it by this share of the radius, and from
/// one in this many of the others.
constexpr double kFurtherOut = 0.1;
constexpr std::size_t kExitPeriod = 48;
/// Number of nodes drawn, of which the furthest is extended.
constexpr int kOutermostOf = 4;
/// Exploration weight (UCB1).
constexpr double kCuriosity = 0.5;
/// Number of tries after which gains are forgotten.
constexpr double kMemory = 200;
/// Number of motions without a new node after which the search ends.
constexpr int kMaxInVain = 400;
/// Number of tries to shorten the path.
constexpr int kShortenTries = 64;

/// Where the next motion starts and what it aims at.
enum class Aim {
  Anywhere,  ///< From the nearest node towards a random pose.
  Shift,     ///< From a node far out along a random direction.
  Turn,      ///< From there about a random axis.
};
constexpr Aim kAims[] = {Aim::Anywhere, Aim::Shift, Aim::Turn};

/// Chooses among kinds of motions by their gains.
class Bandit {
 public:
  std::size_t choose() const {
    double all = 0, best = -1;
    for (const Arm& arm : arms_) all += arm.tries;
    std::size_t chosen = 0;
    for (std::size_t k = 0; k < kCount; ++k) {
      const Arm& arm = arms_[k];
      const double worth = arm.tries < 1 ? std::numeric_limits<double>::infinity()
                                         : arm.gain / arm.tries + kCuriosity * std::sqrt(std::log(all + 1) / arm.tries);
      if (worth > best) {
        best = worth;
        chosen = k;
      }
    }
    return chosen;
  }

  /// @param gain of the arm's last motion, 0 to 1
  void learn(std::size_t arm, double gain) {
    for (Arm& a : arms_) {
      a.tries *= 1 - 1 / kMemory;
      a.gain *= 1 - 1 / kMemory;
    }
    arms_[arm].tries += 1;
    arms_[arm].gain += gain;
  }

  static constexpr std::size_t kCount = std::size(kAims) * std::size(kReaches);

 private:
  struct Arm {
    double tries = 0, gain = 0;
  };
  std::array<Arm, kCount> arms_;
};

class SampleOut {
 public:
  SampleOut(LocalPlanner& local_planner, const BlockingTable& table, ComponentId component, std::size_t max_effort,
            const KeepGoing& keep_going)
      : local_planner_(local_planner),
        component_(component),
        radius_(table.radius(component)),
        exit_distance_(table.max_exit_distance(component)),
        max_effort_(max_effort),
        keep_going_(keep_going),
        random_(max_effort),  // a longer search must not repeat the shorter one
        tree_(table.center(component), radius_),
        out_(1) {}

  const SearchTree& nodes() const { return tree_; }
  /// True if nothing new is found any more.
  bool saturated() const { return in_vain_ > kMaxInVain; }

  std::optional<PlanStep> find() {
    for (; goes_on(); ++in_vain_) {
      const std::size_t arm = bandit_.choose();
      const Aim aim = kAims[arm % std::size(kAims)];
      const double reach = kReaches[arm / std::size(kAims)] * radius_;
      const auto [from, target] = next_motion(aim, reach);
      local_planner_.go_back(tree_[from].pose);
      StepResult made = local_planner_.slide(target);
      double gain = 0;
      if (!made.poses.empty()) {
        const double novelty = tree_.nearest(made.pose).second;
        gain = std::min(1.0, novelty / (kReaches[1] * radius_));
        if (novelty > kSameConfiguration * radius_)
          if (auto step = add_node(from, std::move(made.poses))) return step;
      }
      bandit_.learn(arm, gain);
    }
    return std::nullopt;
  }

 private:
  bool goes_on() const { return !saturated() && local_planner_.effort() < max_effort_ && keep_going_(); }

  Vec3 random_direction() {
    std::normal_distribution<double> normal;
    Vec3 v;
    do v = {normal(random_), normal(random_), normal(random_)};
    while (length_squared(v) < 1e-6);
    return normalized(v);
  }
  double random_share() { return std::uniform_real_distribution<double>(0, 1)(random_); }

  /// The pose rotated by `angle` about its center and translated by `shift`.
  Pose displaced(const Pose& pose, const Vec3& shift, const Vec3& axis, double angle) const {
    const Vec3 center = tree_.center_at(pose);
    const Pose turn{center + shift, quat_about(axis, angle)};
    return turn * Pose{-center, {}} * pose;
  }

  std::pair<std::size_t, Pose> next_motion(Aim aim, double reach) {
    if (aim == Aim::Anywhere) {
      const Vec3 shift = kRegion * radius_ * std::cbrt(random_share()) * random_direction();
      const Pose goal = displaced({}, shift, random_direction(), kHalfTurn * random_share());
      const auto [from, apart] = tree_.nearest(goal);
      return {from, pose_between(tree_[from].pose, goal, std::min(1.0, reach / apart))};
    }
    std::size_t from = random_() % tree_.size();
    for (int k = 1; k < kOutermostOf; ++k) {
      const std::size_t other = random_() % tree_.size();
      if (out_[other] > out_[from]) from = other;
    }
    const Vec3 direction = random_direction();
    const bool turns = aim == Aim::Turn;
    return {from, displaced(tree_[from].pose, turns ? Vec3{} : reach * direction, direction,
                            turns ? std::min(kHalfTurn, reach / radius_) : 0)};
  }

  /// Adds a node. Returns the step if it is outside, or can be left straight.
  std::optional<PlanStep> add_node(std::size_t from, std::vector<Pose> way) {
    const Pose pose = way.back();
    const Vec3 gone = tree_.center_at(pose) - tree_.center_at({});
    tree_.add({pose, from, std::move(way)});
    out_.push_back(length(gone));
    in_vain_ = 0;
    const bool is_out = out_.back() > exit_distance_;
    const bool further = out_.back() > outermost_ + kFurtherOut * radius_;
    if (further) outermost_ = out_.back();
    if (!is_out && !further && tree_.size() % kExitPeriod != 0) return std::nullopt;
    const Vec3 outwards = length(gone) > kSameConfiguration * radius_ ? normalized(gone) : random_direction();
    for (const Vec3& exit : {outwards, random_direction()}) {
      if (!is_out && !local_planner_.exits(exit, 2 * exit_distance_)) continue;
      return PlanStep{
          {component_}, PlanTier::Sampled, PlanStep::kWhole, shortened(tree_.path_to(tree_.size() - 1)), exit};
    }
    return std::nullopt;
  }

  /// Replaces parts of the path by direct motions.
  std::vector<Pose> shortened(std::vector<Pose> way) {
    for (int tries = 0; tries < kShortenTries && way.size() > 2 && keep_going_(); ++tries) {
      std::size_t first = random_() % way.size(), last = random_() % way.size();
      if (first > last) std::swap(first, last);
      if (last - first < 2) continue;
      double as_it_is = 0;
      for (std::size_t k = first; k < last; ++k) as_it_is += tree_.distance(way[k], way[k + 1]);
      local_planner_.go_back(way[first]);
      const StepResult made = local_planner_.slide(way[last]);
      if (!made.reached) continue;
      double at_once = tree_.distance(way[first], made.poses.front());
      for (std::size_t k = 1; k < made.poses.size(); ++k) at_once += tree_.distance(made.poses[k - 1], made.poses[k]);
      if (at_once >= as_it_is) continue;
      const auto begin = way.begin() + static_cast<std::ptrdiff_t>(first) + 1;
      const auto at = way.erase(begin, way.begin() + static_cast<std::ptrdiff_t>(last) + 1);
      way.insert(at, made.poses.begin(), made.poses.end());
    }
    return way;
  }

  LocalPlanner& local_planner_;
  ComponentId component_;
  double radius_, exit_distance_;
  std::size_t max_effort_;
  const KeepGoing& keep_going_;
  std::mt19937_64 random_;
  Bandit bandit_;
  SearchTree tree_;
  std::vector<double> out_;  ///< How far the center is from where it was assembled, at each node [mm].
  double outermost_ = 0;
  int in_vain_ = 0;  ///< Motions since the last new node.
};

}  // namespace

PathSearch sample_out(MotionValidator& validator, const BlockingTable& table, ComponentId component,
                      std::size_t max_effort, const KeepGoing& keep_going) {
  PathSearch search;
  LocalPlanner local_planner(validator, component);
  SampleOut sampling(local_planner, table, component, max_effort, keep_going);
  search.step = sampling.find();
  search.met = local_planner.met();
  search.furthest = sampling.nodes().furthest();
  search.exhausted = sampling.saturated();
  return search;
}

}  // namespace dismantle
