// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/keep_going.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// A step, with the properties and constraints that an order of steps is judged by.
struct OrderedStep {
  static constexpr std::uint32_t kNone = 0xffffffffu;  ///< No step.

  std::uint32_t kind = 0;              ///< Equal for equal components.
  std::uint32_t direction = 0;         ///< Equal for equal directions of exit.
  int up = 0;                          ///< 1 if it leaves upwards, -1 downwards, 0 sideways.
  std::uint32_t tool = 0;              ///< Equal for equal tools; 0: none.
  std::uint32_t followed_by = kNone;   ///< The step that comes next, at once. @pre all that is before it is before this
  std::vector<std::uint32_t> before;   ///< Steps that have to come before it, ascending.
  std::vector<std::uint32_t> held_by;  ///< Steps that remove what holds its components: once all are done, it is loose.
  std::vector<std::uint32_t> rests_on;  ///< Steps that remove what supports its components from below.
};

/// Exits that point up or down by more than this sine are made from above or from below.
inline constexpr double kVertical = 0.2;

/// The cost of each thing that makes an order worse.
struct OrderWeights {
  double groups = 1;       ///< A step of another kind than the one before.
  double direction = 0.5;  ///< Another direction of exit than the step before.
  double upright = 1;      ///< Turning over: from leaving upwards to leaving downwards, or back. Upright at first.
  double tools = 0.25;     ///< Another tool than the last one.
  double loose = 0.05;     ///< Each step during which a component is held no more and still there.
  double support = 0;      ///< A component that has lost all of its support from below before it is removed.
};

/// The cost of an order. @pre `order` has each step once
double order_cost(const std::vector<OrderedStep>& steps, const OrderWeights& weights,
                  const std::vector<std::uint32_t>& order);

/// An order of low cost, by beam search over the sets of steps that are done: of the states that as many steps lead to,
/// those are kept that have the lowest cost together with a lower bound of what is still to come. Each round keeps
/// four times as many, until the bound is met, which proves the order the best, or the work is over. Not more costly
/// than the order 0, 1, 2, ..., which it is unless another one is better. Deterministic.
/// @pre steps come before others in the order 0, 1, 2, ...
/// @param keep_going once it returns false, the best order so far counts
std::vector<std::uint32_t> best_order(const std::vector<OrderedStep>& steps, const OrderWeights& weights,
                                      const KeepGoing& keep_going);

}  // namespace dismantle
