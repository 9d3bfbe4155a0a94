// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/bvh_traverse.h"

#include <cstdint>

namespace dismantle {

///@{ Visits that an item may make before it leaves its remaining pairs to the next round: on CPU threads, and on a
/// device, where a warp waits for its longest thread. What is appended does not depend on it.
inline constexpr int kFrontWorkBudget = 512;
inline constexpr int kDeviceFrontWorkBudget = 24;
///@}
/// Size of the stack of the depth-first traversal; pairs that do not fit are left to the next round, too.
inline constexpr int kFrontStackSize = 96;

/// S_bvh -> S_f, S_t (Du et al. 2015, section 4.3): visits one node pair of the front and, if its bounds overlap,
/// sprouts it, depth-first, down to pairs that are apart or leaves. No pruning.
///
/// The sink receives the output and appends it (staged on CPU threads, by the global or the local lock on a GPU):
///   sink.sprout(i)             front node i is invalid: its descendants replace it
///   sink.keep(key)             a new node of the front
///   sink.rest(key)             a new node whose components have no relative motion: it rests
///   sink.triangle_pair(key)    two leaves whose bounds overlap
///   sink.pend(key)             a pair to be visited in the next round
struct FrontSproutKernel {
  BvhView tree;                            ///< The hierarchy of all components.
  Span<const Kdop16> bounds;               ///< Of the whole step, shape [node_count] [world].
  Span<const std::uint32_t> motion_class;  ///< Equal for components without relative motion, shape [component_count].
  Span<const std::uint64_t> items;         ///< Keys of the front's nodes, or those left by the round before.
  int work_budget = kFrontWorkBudget;      ///< Visits of an item.

  /// First round: item i is a node of the front.
  template <class Sink>
  DISMANTLE_HOST_DEVICE void sprout_node(std::size_t i, Sink& sink) const {
    const NodePair p = pair_of_key(items[i]);
    if (!overlaps(bounds[p.a], bounds[p.b])) return;
    if (tree.is_leaf(p.a) && tree.is_leaf(p.b)) {
      sink.triangle_pair(items[i]);
      return;
    }
    sink.sprout(i);
    descend(p, sink);
  }

  /// Next rounds: item i is a pair left by the round before.
  template <class Sink>
  DISMANTLE_HOST_DEVICE void resume(std::size_t i, Sink& sink) const {
    const NodePair p = pair_of_key(items[i]);
    if (visit(p, sink)) descend(p, sink);
  }

 private:
  /// True if the pair must be expanded; otherwise the sink has received it.
  template <class Sink>
  DISMANTLE_HOST_DEVICE bool visit(NodePair p, Sink& sink) const {
    const bool top = tree.is_top(p.a) || tree.is_top(p.b);
    if (!top) {
      const std::uint32_t a = tree.component_of[p.a], b = tree.component_of[p.b];
      if (a == b) return false;
      if (motion_class[a] == motion_class[b]) {
        sink.rest(pair_key(p.a, p.b));
        return false;
      }
    }
    if (!overlaps(bounds[p.a], bounds[p.b])) {
      sink.keep(pair_key(p.a, p.b));
      return false;
    }
    if (tree.is_leaf(p.a) && tree.is_leaf(p.b)) {
      sink.keep(pair_key(p.a, p.b));
      sink.triangle_pair(pair_key(p.a, p.b));
      return false;
    }
    return true;
  }

  /// Expands the overlapping pair `p`, depth-first.
  template <class Sink>
  DISMANTLE_HOST_DEVICE void descend(NodePair p, Sink& sink) const {
    NodePair stack[kFrontStackSize];
    int open = 0;
    int budget = work_budget;
    stack[open++] = p;
    while (open > 0) {
      const NodePairChildren next = expanded(tree, bounds, stack[--open]);
      for (int k = 0; k < next.count; ++k) {
        --budget;
        if (!visit(next.pair[k], sink)) continue;
        if (open < kFrontStackSize) {
          stack[open++] = next.pair[k];
        } else {
          sink.pend(pair_key(next.pair[k].a, next.pair[k].b));
        }
      }
      if (budget > 0) continue;
      while (open > 0) {
        --open;
        sink.pend(pair_key(stack[open].a, stack[open].b));
      }
    }
  }
};

}  // namespace dismantle
