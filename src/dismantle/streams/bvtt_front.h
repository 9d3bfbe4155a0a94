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

/// Input of an update of a front.
struct FrontInput {
  BvhView tree;                            ///< The hierarchy of all components.
  Span<const Kdop16> bounds;               ///< Of the whole step, shape [node_count] [world].
  Span<const std::uint32_t> motion_class;  ///< Equal for components without relative motion, shape [component_count].
};

/// Cost of an update of a front.
struct FrontUpdate {
  std::size_t replays = 0;  ///< Repetitions because a buffer was full.
  int rounds = 0;           ///< Launches of the kernel.
};

/// The front is never pruned, but restarted from the root when the surplus of visits since the last restart, summed
/// over the updates, is this many times the size that the front had after it (about the cost of a restart). So the
/// front costs at most about twice as much as with the best choice of restarts.
inline constexpr std::size_t kFrontRestartShare = 4;

/// The front stream S_f: a cut through the bounding volume traversal tree (BVTT), kept from step to step and only ever
/// sprouted (Du et al. 2015, section 4.3). Node pairs whose components have no relative motion rest: they stay in the
/// front unvisited, however near, until one of the components moves.
///
/// Guarantee: after update(), triangle_pairs() are exactly the pairs of leaves of different components whose bounds
/// overlap and whose components have a relative motion, whatever the front was before. The result does not depend on
/// executors and capacities.
class Front {
 public:
  /// @param initial_capacity of each append buffer; they grow as needed
  explicit Front(std::size_t initial_capacity, AppendLock lock = AppendLock::Local);

  /// Removes all nodes: the next update starts from the root.
  void restart();

  /// Updates the front for new bounds. @pre the same tree every time; the bounds of every node are valid
  FrontUpdate update(const FrontInput& input, const Executor& executor);

  /// S_t: keys (pair_key) of leaf pairs, ascending.
  Span<const std::uint64_t> triangle_pairs() const { return triangle_pairs_.values(); }
  /// Number of nodes of S_f, including the resting ones.
  std::size_t size() const { return active_.size() + resting_.size(); }
  /// Keys of the nodes that update() visits, in no particular order.
  Span<const std::uint64_t> active() const { return active_; }
  /// Keys of the nodes that rest, in no particular order.
  Span<const std::uint64_t> resting() const { return resting_; }

 private:
  void separate_resting(const FrontInput& input);
  FrontUpdate sprout(const FrontInput& input, const Executor& executor);
  bool grow_full_buffers();
  void replace_sprouted();

  AppendLock lock_;
  std::vector<std::uint64_t> active_, resting_;
  std::vector<std::uint32_t> motion_class_;  // by which active_ and resting_ are separated
  std::size_t fresh_size_ = 0;  // of active_ after the last restart; 0: to be measured after the next update
  std::size_t excess_ = 0;      // visits beyond fresh_size_ since then, summed over the updates
  std::vector<std::uint64_t> scratch_;
  AppendBuffer<std::uint64_t> triangle_pairs_, kept_, rested_, sprouted_;
  AppendBuffer<std::uint64_t> pending_[2];
};

}  // namespace dismantle
