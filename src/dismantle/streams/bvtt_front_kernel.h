// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/bvh_traverse.h"

#include <cstdint>

namespace dismantle {

/// How many node pairs an item may look at before it leaves the rest to the next round.
inline constexpr int kFrontWorkBudget = 512;
/// Room for a depth-first traversal; what does not fit is left to the next round, too.
inline constexpr int kFrontStackSize = 96;

/// S_bvh -> S_f, S_t (Du et al. 2015, section 4.3): looks at one node pair of the front; where its bounds overlap it is
/// sprouted, depth-first, down to pairs that are apart or leaves. No pruning.
///
/// The sink takes what is found (`Sink` decides how it is appended: staged on CPU threads, by the global or the local
/// lock on a GPU):
///   sink.sprout(i)             front node i is invalid: its descendants replace it
///   sink.keep(key)             a new node of the front
///   sink.rest(key)             a new node whose components do not move against each other: it rests
///   sink.triangle_pair(key)    two leaves whose bounds overlap
///   sink.pend(key)             still to be looked at, in the next round
struct FrontSproutKernel {
  BvhView tree;
  Span<const Kdop16> bounds;
  Span<const std::uint32_t> motion_class;  ///< Of each component: equal where two do not move against each other.
  Span<const std::uint64_t> items;         ///< The front's nodes, or what the round before left.

  /// First round: item i is a node of the front.
  template <class Sink>
  DISMANTLE_HOST_DEVICE void look(std::size_t i, Sink& sink) const {
    const NodePair p = pair_of_key(items[i]);
    if (!overlaps(bounds[p.a], bounds[p.b])) return;
    if (tree.is_leaf(p.a) && tree.is_leaf(p.b)) {
      sink.triangle_pair(items[i]);
      return;
    }
    sink.sprout(i);
    descend(p, sink);
  }

  /// Next rounds: item i is a pair that was left over.
  template <class Sink>
  DISMANTLE_HOST_DEVICE void resume(std::size_t i, Sink& sink) const {
    const NodePair p = pair_of_key(items[i]);
    if (visit(p, sink)) descend(p, sink);
  }

 private:
  /// True where the pair must be expanded; otherwise it has gone where it belongs.
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
    int budget = kFrontWorkBudget;
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
