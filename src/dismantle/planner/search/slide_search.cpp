// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/slide_search.h"

#include "dismantle/planner/search/search_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dismantle {

namespace {

/// Length of a push, and of a turn at the component's rim, as a share of its radius.
constexpr double kHandShare = 0.25;
/// A move that advances by less than this share of a push has ended.
constexpr double kStuckShare = 0.05;
/// Configurations nearer than this share of the component's radius count as one.
constexpr double kSameConfiguration = 0.05;
/// Longest turn [rad].
constexpr double kMaxTurn = 6.4;
/// Weight of a node within a move, relative to its end.
constexpr double kEnd = 1, kOnTheWay = 0.5;
/// Penalty for each node between this one and the root.
constexpr double kDepthShare = 0.1;
/// A path within this distance of a straight line is tried as one [share of the component's radius].
constexpr double kStraight = 1e-6;

/// One move of a component.
struct SlideMove {
  Vec3 push;      ///< Unit, or zero.
  TurnAxis axis;  ///< Where not pushed.
};

/// The priority of a node.
struct Promise {
  double worth = 0;
  double depth = 0;   ///< Places before it.
  Quat held;          ///< How the hand holds it turned; walls may have turned it otherwise.
  bool left = false;  ///< All was tried from here.
};

class SlideOut {
 public:
  SlideOut(LocalPlanner& local_planner, const BlockingTable& table, ComponentId component, const SlideMoves& moves,
           const KeepGoing& keep_going)
      : local_planner_(local_planner),
        component_(component),
        radius_(table.radius(component)),
        exit_distance_(table.max_exit_distance(component)),
        max_effort_(moves.max_effort),
        keep_going_(keep_going),
        tree_(table.center(component), radius_),
        promises_(1) {
    for (const Vec3& d : moves.directions) moves_.push_back({d, {}});
    for (const TurnAxis& axis : moves.axes)
      for (const double sign : {1.0, -1.0}) moves_.push_back({{}, {axis.point, sign * axis.direction}});
  }

  const SearchTree& nodes() const { return tree_; }

  std::optional<PlanStep> find() {
    for (;;) {
      const auto best = std::max_element(promises_.begin(), promises_.end(), [](const Promise& a, const Promise& b) {
        return a.left != b.left ? a.left : a.worth < b.worth;
      });
      if (best->left) return std::nullopt;
      best->left = true;
      const auto index = static_cast<std::size_t>(best - promises_.begin());
      for (const SlideMove& move : moves_) {
        if (!goes_on()) return std::nullopt;
        local_planner_.go_back(tree_[index].pose);
        if (auto step = follow(index, move)) return step;
      }
    }
  }

 private:
  bool goes_on() const { return local_planner_.effort() < max_effort_ && keep_going_(); }

  /// Continues a move as long as it advances.
  std::optional<PlanStep> follow(std::size_t from, const SlideMove& move) {
    const bool pushed = length(move.push) > 0;
    const Quat held = promises_[from].held;
    std::vector<Pose> way;
    std::vector<std::size_t> ends;  // of the steps, in `way`
    double turned = 0;
    for (bool stuck = false; !stuck && turned < kMaxTurn && goes_on();) {
      const Pose before = local_planner_.pose();
      const StepResult made = local_planner_.slide(target(before, held, move));
      way.insert(way.end(), made.poses.begin(), made.poses.end());
      stuck = tree_.distance(before, made.pose) < kStuckShare * kHandShare * radius_;
      if (made.poses.empty()) break;
      ends.push_back(way.size());
      turned += pushed ? 0 : hand_turn(move.axis);
      if (pushed && dot(tree_.center_at(made.pose) - tree_.center_at({}), move.push) > exit_distance_)
        return step_out(from, way, move.push);
    }
    if (ends.empty()) return std::nullopt;
    const auto until = [&](std::size_t end) {
      return std::vector<Pose>(way.begin(), way.begin() + static_cast<std::ptrdiff_t>(end));
    };
    // The end first, so that configurations just before it do not become nodes.
    if (reach(from, move, until(ends.back()), kEnd))
      if (auto step = leave(tree_.size() - 1)) return step;
    ends.pop_back();
    for (const std::size_t end : ends) reach(from, move, until(end), kOnTheWay);
    return std::nullopt;
  }

  /// A straight exit from the present node, if there is one.
  std::optional<PlanStep> leave(std::size_t node) {
    std::vector<Vec3> directions;
    for (const SlideMove& move : moves_)
      if (length(move.push) > 0) directions.push_back(move.push);
    for (const Vec3& exit : local_planner_.likely_exits(directions, 2 * exit_distance_))
      if (goes_on() && local_planner_.exits(exit, 2 * exit_distance_))
        return PlanStep{{component_}, PlanTier::Sliding, PlanStep::kWhole, tree_.path_to(node), exit};
    return std::nullopt;
  }

  /// The next target of a move. A push keeps the rotation of its start as far as the contacts allow; otherwise the
  /// component would turn further at every corner, until it is stuck.
  Pose target(const Pose& pose, const Quat& held, const SlideMove& move) const {
    if (length(move.push) > 0) {
      const Vec3 center = tree_.center_at(pose) + kHandShare * radius_ * move.push;
      return {center - tree_.center_at({{}, held}), held};
    }
    Screw screw;
    screw.reference = move.axis.point;
    screw.axis = move.axis.direction;
    screw.angle = hand_turn(move.axis);
    return screw_at(screw, 1) * pose;
  }

  double hand_turn(const TurnAxis& axis) const {
    const double arm = length(cross(axis.direction, tree_.center_at({}) - axis.point)) + radius_;
    return std::min(0.5, kHandShare * radius_ / arm);
  }

  /// Adds a node, if it is new.
  /// @param share weight of its priority
  bool reach(std::size_t from, const SlideMove& move, std::vector<Pose> way, double share) {
    const Pose pose = way.back();
    const double nearest = tree_.nearest(pose).second;
    if (nearest < kSameConfiguration * radius_) return false;
    const double depth = promises_[from].depth + 1;
    const double apart = nearest + tree_.distance({}, pose);
    const Quat held = length(move.push) > 0 ? promises_[from].held : pose.rotation;
    promises_.push_back({share * apart / radius_ - kDepthShare * depth, depth, held, false});
    tree_.add({pose, from, std::move(way)});
    return true;
  }

  /// The path to `from` and on to far outside; its straight end becomes the exit.
  PlanStep step_out(std::size_t from, const std::vector<Pose>& way, const Vec3& exit) {
    std::vector<Pose> whole = tree_.path_to(from);
    whole.insert(whole.end(), way.begin(), way.end());

    const Pose last = whole.back();
    std::size_t first = whole.size() - 1;
    const auto on_line = [&](const Pose& p) {
      const Vec3 apart = last.position - p.position;
      return p.rotation == last.rotation && length(apart - dot(apart, exit) * exit) < kStraight * radius_;
    };
    while (first > 0 && on_line(whole[first - 1])) --first;
    local_planner_.go_back(whole[first]);
    if (local_planner_.exits(exit, 2 * exit_distance_)) whole.resize(first + 1);
    return {{component_}, PlanTier::Sliding, PlanStep::kWhole, std::move(whole), exit};
  }

  LocalPlanner& local_planner_;
  ComponentId component_;
  double radius_, exit_distance_;
  std::size_t max_effort_;
  const KeepGoing& keep_going_;
  std::vector<SlideMove> moves_;
  SearchTree tree_;
  std::vector<Promise> promises_;  ///< Of each node.
};

}  // namespace

PathSearch slide_out(MotionValidator& validator, const BlockingTable& table, ComponentId component,
                     const SlideMoves& moves, const KeepGoing& keep_going) {
  PathSearch search;
  LocalPlanner local_planner(validator, component);
  SlideOut sliding(local_planner, table, component, moves, keep_going);
  search.step = sliding.find();
  search.met = local_planner.met();
  search.furthest = sliding.nodes().furthest();
  search.exhausted = !search.step && local_planner.effort() < moves.max_effort;
  return search;
}

}  // namespace dismantle
