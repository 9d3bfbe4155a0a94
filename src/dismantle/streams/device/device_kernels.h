// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/bvh_refit_kernel.h"
#include "dismantle/exec/append_buffer.h"
#include "dismantle/streams/narrow_phase_kernel.h"
#include "dismantle/streams/vertex_kernel.h"

#include <cstring>

/// The kernels of a step over streams that stay on a device (DeviceStreams). All counts are in the device's memory, so
/// that a step is enqueued without knowing them.
namespace dismantle::device_code {

/// What a step has to compute of one component.
struct ComponentStep {
  std::uint32_t make_vertices = 0;  ///< Not 0: S_v(n+1) is outdated.
  std::uint32_t fit_bounds = 0;     ///< Not 0: S_bv and S_bvh are outdated.
};

/// Input of a step for all components.
struct StepInput {
  std::uint32_t restart_front = 0;  ///< Not 0: the front is restarted from the root.
};

inline constexpr int kFrontRounds = 6;  ///< Rounds after the first that are enqueued at once.
inline constexpr int kNarrowRounds =
    16;  ///< More rounds than any number of pairs needs: they grow by a factor of five.
inline constexpr std::size_t kReportedContacts = 256;  ///< Contacts that are downloaded with the counts.

/// A time of a step as an integer with the same order. @pre time >= 0
DISMANTLE_HOST_DEVICE inline std::uint64_t word_of_time(double time) {
  std::uint64_t word = 0;
  if (time > 0) std::memcpy(&word, &time, sizeof word);
  return word;
}
/// The time of word_of_time().
DISMANTLE_HOST_DEVICE inline double time_of_word(std::uint64_t word) {
  double time = 0;
  std::memcpy(&time, &word, sizeof time);
  return time;
}

/// The counts of a step. Values appended are counted even if there was no room for them.
struct StepCounters {
  std::uint64_t front = 0;                          ///< Nodes of S_f including dead ones; kept from step to step.
  std::uint64_t next_front = 0;                     ///< Nodes of S_f after the step.
  std::uint64_t triangle_pairs = 0;                 ///< S_t
  std::uint64_t kept = 0;                           ///< New nodes of the front.
  std::uint64_t sprouted = 0;                       ///< Nodes of the front that are replaced.
  std::uint64_t pending[kFrontRounds + 1] = {};     ///< Pairs left by each round to the next.
  std::uint64_t complete = 0;                       ///< 1: nothing is pending, and there was room for everything.
  std::uint64_t contacts = 0;                       ///< Triangle pairs that block the motion.
  std::uint64_t intersections = 0;                  ///< Intersecting triangle pairs of S_i.
  std::uint64_t tests = 0;                          ///< Continuous tests left by the filters.
  std::uint64_t reported = 0;                       ///< Contacts in the report.
  std::uint64_t first_toi[kNarrowRounds + 1] = {};  ///< word_of_time of the first contact in the rounds before each.
};

/// Output of a step.
struct StepReport {
  StepCounters counters;                            ///< All counts.
  TrianglePairContact contacts[kReportedContacts];  ///< The first contacts, up to the size of the array.
};

/// Key of a dead node of the front, in the slot of a node that was sprouted without replacement. Never a pair of nodes.
inline constexpr std::uint64_t kDeadNode = ~std::uint64_t{0};

/// Clears the counts, and restarts the front if asked to.
struct BeginStep {
  StepCounters* counters;     ///< Output: all 0, except for `front`.
  const StepInput* input;     ///< The step.
  Span<std::uint64_t> front;  ///< Storage of S_f.
  std::uint64_t root;         ///< The front's first node; kDeadNode if there is none.

  /// Does it.
  DISMANTLE_HOST_DEVICE void operator()() const {
    std::uint64_t nodes = counters->front;
    if (input->restart_front != 0) {
      nodes = root == kDeadNode ? 0 : 1;
      front[0] = root;
    }
    *counters = StepCounters{};
    counters->front = nodes;
  }
};

/// S_v0, S_tm -> S_v(n+1). Item: a vertex; at least one, which also begins the step.
struct MoveVertices {
  BeginStep begin;                         ///< Touches nothing that vertices need.
  Span<const ComponentStep> components;    ///< Shape [component_count].
  Span<const RigidTransform> next;         ///< S_tm: world from assembled, shape [component_count].
  Span<const std::uint32_t> component_of;  ///< Shape [vertex_count].
  Span<const Vec3> assembled;              ///< S_v0 [mm, assembled].
  Span<Vec3> moved;                        ///< Output: S_v(n+1) [mm, world].

  /// Vertex v.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t v) const {
    if (v == 0) begin();
    if (v >= component_of.size()) return;
    const std::uint32_t component = component_of[v];
    if (components[component].make_vertices != 0) VertexUpdateKernel{next[component], assembled, moved}(v);
  }
};

/// S_v -> S_bv, S_bvh in one launch: the second thread that arrives at a node refits it and goes on to its parent
/// (Karras 2012). A component with valid bounds is represented by its root. Item: a leaf.
struct FitBounds {
  BvhRefitLeafKernel leaf_kernel;        ///< Fits a leaf.
  BvhRefitNodeKernel node_kernel;        ///< Fits an inner node to its children.
  Span<const ComponentStep> components;  ///< Shape [component_count].
  Span<const BvhComponent> ranges;       ///< Shape [component_count].
  Span<const NodeIndex> parent;          ///< Shape [node_count]; kNoNode for the root.
  Span<std::uint32_t> arrivals;          ///< Shape [inner node count]; 0 before and after.

  /// Leaf `leaf`.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t leaf) const {
    const BvhView& tree = node_kernel.tree;
    const std::uint32_t component = tree.component_of[leaf];
    auto node = static_cast<NodeIndex>(leaf);
    if (components[component].fit_bounds != 0) {
      leaf_kernel(leaf);
    } else {
      if (leaf != ranges[component].leaf_begin) return;
      node = ranges[component].root;
    }
    for (node = parent[node]; node != kNoNode; node = parent[node]) {
      const NodeIndex inner = node - tree.leaf_count;
      if (arrive(&arrivals[inner]) == 0) return;
      arrivals[inner] = 0;
      node_kernel(inner);
    }
  }
};

/// Sink of FrontSproutKernel that appends with one atomic addition for the threads of a warp that append together (the
/// paper's global lock: one a value; docs/gpu.md compares them). Pairs without relative motion are dropped, as the
/// front is restarted when that changes.
struct FrontSink {
  AppendView<std::uint64_t> triangle_pairs;  ///< S_t, keys.
  AppendView<std::uint64_t> kept;            ///< Keys of new nodes.
  AppendView<std::uint64_t> sprouted;        ///< Slots of the front.
  AppendView<std::uint64_t> pending;         ///< Keys for the next round.

  ///@{ See FrontSproutKernel.
  DISMANTLE_HOST_DEVICE void sprout(std::size_t index) const { sprouted.append_together(index); }
  DISMANTLE_HOST_DEVICE void keep(std::uint64_t key) const { kept.append_together(key); }
  DISMANTLE_HOST_DEVICE void rest(std::uint64_t) const {}
  DISMANTLE_HOST_DEVICE void triangle_pair(std::uint64_t key) const { triangle_pairs.append_together(key); }
  DISMANTLE_HOST_DEVICE void pend(std::uint64_t key) const { pending.append_together(key); }
  ///@}
};

/// S_bvh -> S_f, S_t, first round. Item: a slot of the front.
struct SproutFront {
  FrontSproutKernel kernel;      ///< Its items are all slots of the front.
  FrontSink sink;                ///< Output.
  const StepCounters* counters;  ///< Its `front` slots are in use.

  /// Slot i.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    if (i < counters->front && kernel.items[i] != kDeadNode) kernel.sprout_node(i, sink);
  }
};

/// S_bvh -> S_f, S_t, next rounds. Item: a slot of the pending pairs.
struct ResumeFront {
  FrontSproutKernel kernel;   ///< Its items are all slots of the pending pairs.
  FrontSink sink;             ///< Output.
  const std::uint64_t* left;  ///< Number of pending pairs.

  /// Slot i.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    if (i < *left) kernel.resume(i, sink);
  }
};

/// Prepares further rounds: the pairs left by the last round are those of the next one. One item.
struct CarryPending {
  StepCounters* counters;  ///< Its `pending` counts are moved.

  /// The item.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t) const {
    counters->pending[0] = counters->pending[kFrontRounds];
    for (int round = 1; round <= kFrontRounds; ++round) counters->pending[round] = 0;
  }
};

/// Sizes of the arrays that the front is appended to.
struct StepCapacity {
  ///@{ Of the arrays of StepCounters with these names.
  std::uint64_t front = 0, triangle_pairs = 0, kept = 0, sprouted = 0, pending = 0;
  ///@}

  /// The size of the front after the step.
  DISMANTLE_HOST_DEVICE static std::uint64_t front_needed(const StepCounters& counters) {
    return counters.front + (counters.kept > counters.sprouted ? counters.kept - counters.sprouted : 0);
  }
  /// The largest number of pairs that a round left.
  DISMANTLE_HOST_DEVICE static std::uint64_t max_pending(const StepCounters& counters) {
    std::uint64_t largest = 0;
    for (const std::uint64_t count : counters.pending) largest = count > largest ? count : largest;
    return largest;
  }
  /// True if the arrays are large enough.
  DISMANTLE_HOST_DEVICE bool fits_front(const StepCounters& counters) const {
    return front_needed(counters) <= front && counters.triangle_pairs <= triangle_pairs && counters.kept <= kept &&
           counters.sprouted <= sprouted && max_pending(counters) <= pending;
  }
};

/// Sets `complete` if nothing is pending and all arrays were large enough, and the size of the front after the step.
/// One item.
struct CompleteFront {
  StepCounters* counters;  ///< Its `complete` and `next_front` are set.
  StepCapacity capacity;   ///< Of the arrays.

  /// The item.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t) const {
    counters->complete = counters->pending[kFrontRounds] == 0 && capacity.fits_front(*counters) ? 1 : 0;
    counters->next_front = counters->complete != 0 ? StepCapacity::front_needed(*counters) : counters->front;
  }
};

/// Writes the new nodes into the slots of those that were sprouted. Item: a new node, or one that was sprouted.
struct ReplaceSprouted {
  const StepCounters* counters;        ///< Nothing happens if not `complete`.
  Span<const std::uint64_t> kept;      ///< Keys of new nodes.
  Span<const std::uint64_t> sprouted;  ///< Slots of the front.
  Span<std::uint64_t> front;           ///< Storage of S_f.

  /// New node i and slot i.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    if (counters->complete == 0) return;
    const bool has_kept = i < counters->kept, has_slot = i < counters->sprouted;
    if (has_slot) {
      front[sprouted[i]] = has_kept ? kept[i] : kDeadNode;
    } else if (has_kept) {
      front[counters->front + i - counters->sprouted] = kept[i];
    }
  }
};

/// Ends the front and begins the narrow phase: sets the size of the front, clears the counts of the narrow phase, and
/// fills the unused slots of S_t with the largest key, so that they can be sorted. May be repeated. Item: a slot; at
/// least one.
struct BeginNarrowPhase {
  StepCounters* counters;              ///< Its `triangle_pairs` slots are in use.
  Span<std::uint64_t> triangle_pairs;  ///< The slots of S_t that are sorted.

  /// Slot i.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    if (i >= counters->triangle_pairs) triangle_pairs[i] = ~std::uint64_t{0};
    if (i > 0) return;
    counters->front = counters->next_front;
    counters->contacts = counters->intersections = counters->tests = counters->reported = 0;
    for (std::uint64_t& word : counters->first_toi) word = word_of_time(1);
  }
};

/// The time of the step after which contacts do not matter when `rounds` rounds are done.
DISMANTLE_HOST_DEVICE inline double horizon_of(const StepCounters& counters, int rounds) {
  std::uint64_t first = counters.first_toi[0];
  for (int k = 1; k <= rounds; ++k) first = counters.first_toi[k] < first ? counters.first_toi[k] : first;
  return horizon_after(time_of_word(first));
}

/// Sink of NarrowPhaseKernel.
struct NarrowSink {
  AppendView<TrianglePairContact> contacts;  ///< Pairs that block the motion.
  AppendView<std::uint64_t> intersections;   ///< Keys of intersecting pairs of S_i.
  StepCounters* counters;                    ///< Counts of the step.
  int round;                                 ///< Index of the round.

  ///@{ See NarrowPhaseKernel.
  DISMANTLE_HOST_DEVICE void contact(const TrianglePairContact& found) const {
    contacts.append_together(found);
    atomic_lower(&counters->first_toi[round + 1], word_of_time(found.toi));
  }
  DISMANTLE_HOST_DEVICE void intersection(std::uint64_t key) const { intersections.append_together(key); }
  DISMANTLE_HOST_DEVICE void tested(std::size_t count) const {
    if (count > 0) atomic_sum(&counters->tests, static_cast<std::uint32_t>(count));
  }
  ///@}
};

/// One round of S_t -> contacts and intersections, by the tests of `kTests` (NarrowTests). Item: a triangle pair of the
/// round.
template <unsigned kTests>
struct TestTrianglePairs {
  NarrowPhaseKernel kernel;  ///< Its pairs are all slots of S_t.
  NarrowSink sink;           ///< Output.
  std::size_t begin;         ///< First triangle pair of the round.

  /// Triangle pair `begin` + i.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    const StepCounters& counters = *sink.counters;
    if (counters.complete == 0 || begin + i >= counters.triangle_pairs) return;
    kernel.template run<kTests>(begin + i, horizon_of(counters, sink.round), sink);
  }
};

/// Reports the contacts within kContactWindow of the first one. Item: a slot of the contacts.
struct ReportFirstContacts {
  const StepCounters* counters;              ///< Its `contacts` slots are in use.
  Span<const TrianglePairContact> contacts;  ///< Storage of the contacts.
  AppendView<TrianglePairContact> reported;  ///< Output.

  /// Slot i.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    if (i < counters->contacts && contacts[i].toi <= horizon_of(*counters, kNarrowRounds))
      reported.append_together(contacts[i]);
  }
};

}  // namespace dismantle::device_code
