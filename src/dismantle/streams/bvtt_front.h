// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/bvh.h"
#include "dismantle/exec/append_buffer.h"
#include "dismantle/exec/executor.h"
#include "dismantle/geometry/kdop.h"
#include "dismantle/streams/bvtt_front_kernel.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// What a front is updated from.
struct FrontInput {
  BvhView tree;
  Span<const Kdop16> bounds;               ///< Of the whole step, shape [node_count].
  Span<const std::uint32_t> motion_class;  ///< Of each component: equal where two do not move against each other.
};

/// How an update went.
struct FrontUpdate {
  std::size_t replays = 0;  ///< Times that it ran again because a buffer was full.
  int rounds = 0;           ///< Launches of the kernel.
};

/// The front is never pruned, so it is started anew from the root now and then: when the nodes that were looked at for
/// nothing since the last start, beyond the number that it had then, add up to this many times that number (which is
/// about what a start costs). So the front costs at most about twice as much as with the best choice of starts.
inline constexpr std::size_t kFrontRestartShare = 4;

/// The front stream S_f: a cut through the bounding volume traversal tree (BVTT), kept from step to step and only ever
/// sprouted (Du et al. 2015, section 4.3). Node pairs whose components do not move against each other rest: they stay
/// as they are, however near, until one of them moves.
///
/// Guarantee: after update(), triangle_pairs() are exactly the pairs of leaves of different components whose bounds
/// overlap and whose components move against each other, whatever the front was before. Executors and capacities make
/// no difference.
class Front {
 public:
  /// @param initial_capacity of each append buffer; they grow as needed
  explicit Front(std::size_t initial_capacity);

  /// Forgets all nodes: the next update starts from the root.
  void restart();

  /// Brings the front up to the bounds. @pre the same tree every time; every node is fitted
  FrontUpdate update(const FrontInput& input, const Executor& executor);

  /// S_t: keys (pair_key) of leaf pairs, ascending.
  Span<const std::uint64_t> triangle_pairs() const { return triangle_pairs_.values(); }
  /// S_f, the resting nodes included.
  std::size_t size() const { return active_.size() + resting_.size(); }
  /// Nodes that update() looks at; keys, in no particular order.
  Span<const std::uint64_t> active() const { return active_; }
  /// Nodes that rest; keys, in no particular order.
  Span<const std::uint64_t> resting() const { return resting_; }

 private:
  void separate_resting(const FrontInput& input);
  FrontUpdate sprout(const FrontInput& input, const Executor& executor);
  bool grow_full_buffers();
  void replace_sprouted();

  std::vector<std::uint64_t> active_, resting_;
  std::vector<std::uint32_t> motion_class_;  // that active_ and resting_ are separated by
  std::size_t fresh_size_ = 0;               // of active_ after the last start; 0: to be measured after the next update
  std::size_t excess_ = 0;                   // nodes looked at beyond fresh_size_ since then, summed over the updates
  std::vector<std::uint64_t> scratch_;
  AppendBuffer<std::uint64_t> triangle_pairs_, kept_, rested_, sprouted_;
  AppendBuffer<std::uint64_t> pending_[2];
};

}  // namespace dismantle
