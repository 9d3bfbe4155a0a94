// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/order/step_order.h"

#include "dismantle/core/contract.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <unordered_set>

namespace dismantle {

namespace {

constexpr std::uint32_t kNone = OrderedStep::kNone;
/// States that are kept for each number of steps: in the first round, and the factor of the next.
constexpr std::size_t kFirstWidth = 4, kWider = 4, kWidest = 256;
/// Continuations that all rounds together may examine.
constexpr std::size_t kMostWork = 3'000'000;
/// Costs that differ by less are equal.
constexpr double kSameCost = 1e-9;

/// A set of steps that are done, and what the cost of the next one depends on.
struct State {
  std::vector<std::uint8_t> done;        // of each step
  std::vector<std::uint32_t> waiting;    // of each step: how many have to come before it still
  std::vector<std::uint32_t> available;  // steps that wait for nothing, ascending
  std::vector<std::uint32_t> kinds_left, directions_left, tools_left;  // steps left of each
  std::uint32_t kinds = 0, directions = 0, tools = 0;                  // those that are left
  std::uint32_t up_left = 0, down_left = 0;
  std::uint32_t kind = kNone, direction = kNone, tool = 0;  // of the last step; the last tool
  int up = 1;
  std::uint32_t loose = 0;
  std::uint64_t hash = 0;  // of `done`
  double cost = 0;
  std::uint32_t trace = kNone;  // the last step's place in the tree of steps
};

std::uint64_t hash_of(std::uint64_t x) {  // SplitMix64
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// Steps, with the relations of each in both directions.
class OrderProblem {
 public:
  OrderProblem(const std::vector<OrderedStep>& steps, const OrderWeights& weights)
      : steps_(steps), weights_(weights), next_(steps.size()), frees_(steps.size()), supports_(steps.size()) {
    for (std::uint32_t k = 0; k < steps.size(); ++k) {
      for (const std::uint32_t j : steps[k].before) next_[j].push_back(k);
      for (const std::uint32_t j : steps[k].held_by) frees_[j].push_back(k);
      for (const std::uint32_t j : steps[k].rests_on) supports_[j].push_back(k);
    }
  }

  std::size_t size() const { return steps_.size(); }

  State start() const {
    State s;
    s.done.resize(size());
    s.waiting.resize(size());
    const auto count = [](std::vector<std::uint32_t>& left, std::uint32_t which, std::uint32_t& kinds) {
      if (left.size() <= which) left.resize(which + 1);
      kinds += left[which]++ == 0;
    };
    for (std::uint32_t k = 0; k < size(); ++k) {
      s.waiting[k] = static_cast<std::uint32_t>(steps_[k].before.size());
      if (s.waiting[k] == 0) s.available.push_back(k);
      count(s.kinds_left, steps_[k].kind, s.kinds);
      count(s.directions_left, steps_[k].direction, s.directions);
      if (steps_[k].tool != 0) count(s.tools_left, steps_[k].tool, s.tools);
      s.up_left += steps_[k].up > 0;
      s.down_left += steps_[k].up < 0;
    }
    return s;
  }

  /// The cost of a step after a state. @pre it is available
  double cost_after(const State& s, std::uint32_t k) const {
    const OrderedStep& step = steps_[k];
    double cost = 0;
    if (step.kind != s.kind) cost += weights_.groups;
    if (step.direction != s.direction && s.direction != kNone) cost += weights_.direction;
    if (step.up != 0 && step.up != s.up) cost += weights_.upright;
    if (step.tool != 0 && s.tool != 0 && step.tool != s.tool) cost += weights_.tools;
    if (weights_.loose > 0) cost += weights_.loose * loose_after(s, k);
    if (weights_.support > 0)
      for (const std::uint32_t p : supports_[k])
        if (loses_last(s, k, p, steps_[p].rests_on)) cost += weights_.support;
    return cost;
  }

  /// A lower bound of the cost of all that follows a step after a state: each kind that is left, and not its own, is
  /// begun at least once.
  double least_after(const State& s, std::uint32_t k) const {
    const OrderedStep& step = steps_[k];
    double least = weights_.groups * (s.kinds - 1) + weights_.direction * (s.directions - 1);
    if (s.tools > 0) least += weights_.tools * (s.tools - 1);
    const int up = step.up != 0 ? step.up : s.up;
    const bool turns = up > 0 ? s.down_left > 0 : s.up_left > 0;
    return least + (turns ? weights_.upright : 0);
  }

  /// The state after a step. @param cost of that state
  void go(State& s, std::uint32_t k, double cost) const {
    const OrderedStep& step = steps_[k];
    s.loose = loose_after(s, k);
    s.cost = cost;
    s.done[k] = 1;
    s.hash ^= hash_of(k);
    s.available.erase(std::lower_bound(s.available.begin(), s.available.end(), k));
    for (const std::uint32_t next : next_[k])
      if (--s.waiting[next] == 0)
        s.available.insert(std::lower_bound(s.available.begin(), s.available.end(), next), next);
    s.kinds -= --s.kinds_left[step.kind] == 0;
    s.directions -= --s.directions_left[step.direction] == 0;
    if (step.tool != 0) s.tools -= --s.tools_left[step.tool] == 0;
    s.up_left -= step.up > 0;
    s.down_left -= step.up < 0;
    s.kind = step.kind;
    s.direction = step.direction;
    if (step.tool != 0) s.tool = step.tool;
    if (step.up != 0) s.up = step.up;
  }

 private:
  bool loses_last(const State& s, std::uint32_t k, std::uint32_t p, const std::vector<std::uint32_t>& holders) const {
    return s.done[p] == 0 &&
           std::all_of(holders.begin(), holders.end(), [&](std::uint32_t h) { return h == k || s.done[h] != 0; });
  }

  std::uint32_t loose_after(const State& s, std::uint32_t k) const {
    std::uint32_t loose = s.loose;
    for (const std::uint32_t p : frees_[k]) loose += loses_last(s, k, p, steps_[p].held_by);
    const std::vector<std::uint32_t>& holders = steps_[k].held_by;
    if (!holders.empty() &&
        std::all_of(holders.begin(), holders.end(), [&](std::uint32_t h) { return s.done[h] != 0; }))
      --loose;
    return loose;
  }

  const std::vector<OrderedStep>& steps_;
  const OrderWeights& weights_;
  std::vector<std::vector<std::uint32_t>> next_, frees_, supports_;
};

/// A beam search.
class OrderSearch {
 public:
  OrderSearch(const OrderProblem& problem, const std::vector<OrderedStep>& steps, const KeepGoing& keep_going)
      : problem_(problem), steps_(steps), keep_going_(keep_going) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> classes;
    for (const OrderedStep& step : steps)
      class_of_.push_back(
          classes.try_emplace({step.kind, step.direction}, static_cast<std::uint32_t>(classes.size())).first->second);
    classes_ = classes.size();
  }

  struct Found {
    double cost;
    std::vector<std::uint32_t> order;
  };

  /// The best order that a beam of a width finds; nothing if the work is over.
  std::optional<Found> run(std::size_t width) {
    trace_.clear();
    std::vector<State> beam{problem_.start()};
    for (std::size_t done = 0; done < problem_.size(); ++done) {
      std::vector<Continuation> next = continuations(beam, width);
      if (work_ > kMostWork || !keep_going_()) return std::nullopt;
      beam = best_of(std::move(beam), next, width);
    }
    Found found{beam.front().cost, {}};
    for (std::uint32_t at = beam.front().trace; at != kNone; at = trace_[at].first)
      found.order.push_back(trace_[at].second);
    std::reverse(found.order.begin(), found.order.end());
    return found;
  }

  std::size_t work() const { return work_; }

 private:
  struct Continuation {
    std::int64_t bound;  // of the cost of the whole order [kSameCost], so that equal ones compare as equal
    double cost;
    std::uint32_t state, step;
  };

  /// The continuations of all states, the best first. @param equal_ones of a state that are examined: steps of one kind
  /// and direction
  std::vector<Continuation> continuations(const std::vector<State>& beam, std::size_t equal_ones) {
    std::vector<Continuation> next;
    for (std::uint32_t i = 0; i < beam.size(); ++i) {
      const State& s = beam[i];
      const auto add = [&](std::uint32_t k) {
        ++work_;
        const double cost = s.cost + problem_.cost_after(s, k);
        next.push_back({std::llround((cost + problem_.least_after(s, k)) / kSameCost), cost, i, k});
      };
      if (s.trace != kNone && steps_[trace_[s.trace].second].followed_by != kNone) {
        add(steps_[trace_[s.trace].second].followed_by);
        continue;
      }
      examined_.assign(classes_, 0);
      for (const std::uint32_t k : s.available) {
        if (examined_[class_of_[k]]++ >= equal_ones) continue;
        add(k);
      }
    }
    std::sort(next.begin(), next.end(), [](const Continuation& a, const Continuation& b) {
      return std::tie(a.bound, a.state, a.step) < std::tie(b.bound, b.state, b.step);
    });
    return next;
  }

  std::vector<State> best_of(std::vector<State> beam, const std::vector<Continuation>& next, std::size_t width) {
    std::vector<State> kept;
    std::unordered_set<std::uint64_t> known;
    for (const Continuation& c : next) {
      if (kept.size() == width) break;
      const OrderedStep& step = steps_[c.step];
      const State& s = beam[c.state];
      const int up = step.up != 0 ? step.up : s.up;
      const std::uint32_t tool = step.tool != 0 ? step.tool : s.tool;
      std::uint64_t hash = s.hash ^ hash_of(c.step);
      for (const std::uint64_t part : {std::uint64_t{step.kind}, std::uint64_t{step.direction}, std::uint64_t{tool},
                                       static_cast<std::uint64_t>(up + 1)})
        hash = hash_of(hash ^ part);
      if (!known.insert(hash).second) continue;
      kept.push_back(s);
      problem_.go(kept.back(), c.step, c.cost);
      trace_.emplace_back(s.trace, c.step);
      kept.back().trace = static_cast<std::uint32_t>(trace_.size() - 1);
    }
    return kept;
  }

  const OrderProblem& problem_;
  const std::vector<OrderedStep>& steps_;
  const KeepGoing& keep_going_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> trace_;  // the place of the step before, and the step
  std::vector<std::uint32_t> class_of_;                         // of each step: its kind and direction
  std::size_t classes_ = 0;
  std::vector<std::size_t> examined_;  // of each class
  std::size_t work_ = 0;
};

}  // namespace

double order_cost(const std::vector<OrderedStep>& steps, const OrderWeights& weights,
                  const std::vector<std::uint32_t>& order) {
  DISMANTLE_EXPECT(order.size() == steps.size());
  const OrderProblem problem(steps, weights);
  State s = problem.start();
  for (const std::uint32_t k : order) {
    DISMANTLE_EXPECT(s.done[k] == 0 && s.waiting[k] == 0);
    problem.go(s, k, s.cost + problem.cost_after(s, k));
  }
  return s.cost;
}

std::vector<std::uint32_t> best_order(const std::vector<OrderedStep>& steps, const OrderWeights& weights,
                                      const KeepGoing& keep_going) {
  std::vector<std::uint32_t> best(steps.size());
  std::iota(best.begin(), best.end(), 0u);
  if (steps.size() < 2) return best;
  const OrderProblem problem(steps, weights);
  double cost = order_cost(steps, weights, best);
  const State start = problem.start();
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t k : start.available)
    least = std::min(least, problem.cost_after(start, k) + problem.least_after(start, k));
  OrderSearch search(problem, steps, keep_going);
  for (std::size_t width = kFirstWidth; width <= kWidest && cost > least + kSameCost; width *= kWider) {
    std::optional<OrderSearch::Found> found = search.run(width);
    if (!found) break;
    if (found->cost < cost - kSameCost) {
      cost = found->cost;
      best = std::move(found->order);
    }
    if (kWider * search.work() > kMostWork) break;  // the next round would not end
  }
  return best;
}

}  // namespace dismantle
