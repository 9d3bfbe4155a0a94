// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/bvh_refit_kernel.h"
#include "dismantle/exec/append_buffer.h"
#include "dismantle/streams/narrow_phase_kernel.h"
#include "dismantle/streams/vertex_kernel.h"

#include <cstring>

/// The bodies of a step over streams that stay on a device (DeviceStreams): the kernels of method `streams`, with all
/// counts in the device's memory, so that a step is enqueued without knowing them.
namespace dismantle::device_code {

/// What the host says of a component each step: a line of S_tm.
struct ComponentStep {
  RigidTransform next;
  std::uint32_t make_vertices = 0;  ///< Not 0: S_v(n+1) is not that of `next` yet.
  std::uint32_t fit_bounds = 0;     ///< Not 0: S_bv, S_bvh are of another motion.
};

/// What the host says of a step.
struct StepOrder {
  double path_deviation = 0;        ///< [mm]
  std::uint32_t restart_front = 0;  ///< Not 0: the front starts anew from the root.
};

inline constexpr int kFrontRounds = 4;    ///< Rounds after the first that are enqueued at once.
inline constexpr int kNarrowRounds = 16;  ///< More than triangle pairs can make: the rounds grow by a factor of five.
inline constexpr std::size_t kReportedContacts = 256;

/// A time of a step as a word, in the same order. @pre time >= 0
DISMANTLE_HOST_DEVICE inline std::uint64_t word_of_time(double time) {
  std::uint64_t word = 0;
  if (time > 0) std::memcpy(&word, &time, sizeof word);
  return word;
}
DISMANTLE_HOST_DEVICE inline double time_of_word(std::uint64_t word) {
  double time = 0;
  std::memcpy(&time, &word, sizeof time);
  return time;
}

/// The counts of a step: of what was appended, whether there was room for it or not.
struct StepCounters {
  std::uint64_t front = 0;  ///< Nodes of S_f, those that are dead included: stays from step to step.
  std::uint64_t triangle_pairs = 0, kept = 0, sprouted = 0;
  std::uint64_t pending[kFrontRounds + 1] = {};  ///< What each round left to the next.
  std::uint64_t complete = 0;                    ///< 1: nothing was left over and there was room for everything.
  std::uint64_t contacts = 0, intersections = 0, tests = 0, reported = 0;
  std::uint64_t first_toi[kNarrowRounds + 1] = {};  ///< word_of_time of the first contact of the rounds before each.
};

/// What comes back from a step.
struct StepReport {
  StepCounters counters;
  TrianglePairContact contacts[kReportedContacts];  ///< The first ones, as many as there is room for.
};

/// A node of the front that is none: those that were sprouted into nothing leave it. Never a pair of nodes.
inline constexpr std::uint64_t kDeadNode = ~std::uint64_t{0};

/// Clears the counts. One item.
struct BeginStep {
  StepCounters* counters;
  const StepOrder* order;
  Span<std::uint64_t> front;
  std::uint64_t root;  ///< The front's first node; kDeadNode where it has none.

  DISMANTLE_HOST_DEVICE void operator()(std::size_t) const {
    std::uint64_t nodes = counters->front;
    if (order->restart_front != 0) {
      nodes = root == kDeadNode ? 0 : 1;
      front[0] = root;
    }
    *counters = StepCounters{};
    counters->front = nodes;
  }
};

/// S_v0, S_tm -> S_v(n+1). Item: a vertex.
struct MoveVertices {
  Span<const ComponentStep> components;
  Span<const std::uint32_t> component_of;  ///< Of each vertex.
  Span<const Vec3> assembled;
  Span<Vec3> moved;

  DISMANTLE_HOST_DEVICE void operator()(std::size_t v) const {
    const ComponentStep& component = components[component_of[v]];
    if (component.make_vertices != 0) VertexUpdateKernel{component.next, assembled, moved}(v);
  }
};

/// S_v -> S_bv, S_bvh in one launch: whoever comes to a node second fits it and goes on to its parent (Karras 2012). A
/// component whose bounds still fit is represented by its root. Item: a leaf.
struct FitBounds {
  BvhRefitLeafKernel leaf_kernel;
  BvhRefitNodeKernel node_kernel;
  Span<const ComponentStep> components;
  Span<const BvhComponent> ranges;
  Span<const NodeIndex> parent;  ///< Of each node; kNoNode of the root.
  Span<std::uint32_t> arrivals;  ///< Of each inner node; 0, and 0 again afterwards.

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

/// Where the front's kernel puts what it finds: the paper's global lock.
struct FrontSink {
  AppendView<std::uint64_t> triangle_pairs, kept, sprouted, pending;

  DISMANTLE_HOST_DEVICE void sprout(std::size_t index) const { sprouted.append(index); }
  DISMANTLE_HOST_DEVICE void keep(std::uint64_t key) const { kept.append(key); }
  /// Pairs that do not move against each other are not kept: the front starts anew when that changes.
  DISMANTLE_HOST_DEVICE void rest(std::uint64_t) const {}
  DISMANTLE_HOST_DEVICE void triangle_pair(std::uint64_t key) const { triangle_pairs.append(key); }
  DISMANTLE_HOST_DEVICE void pend(std::uint64_t key) const { pending.append(key); }
};

/// S_bvh -> S_f, S_t, first round. Item: a place of the front.
struct LookAtFront {
  FrontSproutKernel kernel;
  FrontSink sink;
  const StepCounters* counters;

  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    if (i < counters->front && kernel.items[i] != kDeadNode) kernel.look(i, sink);
  }
};

/// Next rounds. Item: a place of what the round before left.
struct ResumeFront {
  FrontSproutKernel kernel;
  FrontSink sink;
  const std::uint64_t* left;

  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    if (i < *left) kernel.resume(i, sink);
  }
};

/// More rounds are to come: what the last one left is what the next one gets. One item.
struct PassOnPending {
  StepCounters* counters;

  DISMANTLE_HOST_DEVICE void operator()(std::size_t) const {
    counters->pending[0] = counters->pending[kFrontRounds];
    for (int round = 1; round <= kFrontRounds; ++round) counters->pending[round] = 0;
  }
};

/// How much room there is for what the front appends.
struct StepCapacity {
  std::uint64_t front = 0, triangle_pairs = 0, kept = 0, sprouted = 0, pending = 0;

  DISMANTLE_HOST_DEVICE static std::uint64_t front_needed(const StepCounters& counters) {
    return counters.front + (counters.kept > counters.sprouted ? counters.kept - counters.sprouted : 0);
  }
  DISMANTLE_HOST_DEVICE static std::uint64_t max_pending(const StepCounters& counters) {
    std::uint64_t most = 0;
    for (const std::uint64_t count : counters.pending) most = count > most ? count : most;
    return most;
  }
  DISMANTLE_HOST_DEVICE bool holds_front(const StepCounters& counters) const {
    return front_needed(counters) <= front && counters.triangle_pairs <= triangle_pairs && counters.kept <= kept &&
           counters.sprouted <= sprouted && max_pending(counters) <= pending;
  }
};

/// Finds out whether the front is done. One item.
struct CompleteFront {
  StepCounters* counters;
  StepCapacity capacity;

  DISMANTLE_HOST_DEVICE void operator()(std::size_t) const {
    counters->complete = counters->pending[kFrontRounds] == 0 && capacity.holds_front(*counters) ? 1 : 0;
  }
};

/// Puts the new nodes in the place of those that were sprouted. Item: a new node or one that was sprouted.
struct ReplaceSprouted {
  const StepCounters* counters;
  Span<const std::uint64_t> kept, sprouted;
  Span<std::uint64_t> front;

  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    if (counters->complete == 0) return;
    const bool has_kept = i < counters->kept, has_place = i < counters->sprouted;
    if (has_place) {
      front[sprouted[i]] = has_kept ? kept[i] : kDeadNode;
    } else if (has_kept) {
      front[counters->front + i - counters->sprouted] = kept[i];
    }
  }
};

/// One item.
struct EndFront {
  StepCounters* counters;

  DISMANTLE_HOST_DEVICE void operator()(std::size_t) const {
    if (counters->complete != 0) counters->front = StepCapacity::front_needed(*counters);
  }
};

/// Fills S_t's storage behind its keys, so that all of it can be sorted. Item: a place of it.
struct PadTrianglePairs {
  const StepCounters* counters;
  Span<std::uint64_t> triangle_pairs;

  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    if (i >= counters->triangle_pairs) triangle_pairs[i] = ~std::uint64_t{0};
  }
};

/// Clears the counts of the narrow phase. One item.
struct BeginNarrowPhase {
  StepCounters* counters;

  DISMANTLE_HOST_DEVICE void operator()(std::size_t) const {
    counters->contacts = counters->intersections = counters->tests = counters->reported = 0;
    for (std::uint64_t& word : counters->first_toi) word = word_of_time(1);
  }
};

/// How far it is worth to look when `rounds` rounds are done.
DISMANTLE_HOST_DEVICE inline double horizon_of(const StepCounters& counters, int rounds) {
  std::uint64_t first = counters.first_toi[0];
  for (int k = 1; k <= rounds; ++k) first = counters.first_toi[k] < first ? counters.first_toi[k] : first;
  return horizon_after(time_of_word(first));
}

/// Where the narrow phase's kernel puts what it finds.
struct NarrowSink {
  AppendView<TrianglePairContact> contacts;
  AppendView<std::uint64_t> intersections;
  StepCounters* counters;
  int round;

  DISMANTLE_HOST_DEVICE void contact(const TrianglePairContact& found) const {
    contacts.append(found);
    atomic_lower(&counters->first_toi[round + 1], word_of_time(found.toi));
  }
  DISMANTLE_HOST_DEVICE void intersection(std::uint64_t key) const { intersections.append(key); }
  DISMANTLE_HOST_DEVICE void tested(std::size_t count) const {
    if (count > 0) atomic_add(&counters->tests, count);
  }
};

/// One round of S_t -> contacts and intersections. Item: a triangle pair of the round.
struct TestTrianglePairs {
  NarrowPhaseKernel kernel;  ///< Its pairs are all of S_t's storage.
  NarrowSink sink;
  const StepOrder* order;
  std::size_t begin;  ///< Of the round.

  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    const StepCounters& counters = *sink.counters;
    if (counters.complete == 0 || begin + i >= counters.triangle_pairs) return;
    NarrowPhaseKernel own = kernel;
    own.path_deviation = order->path_deviation;
    own.horizon = horizon_of(counters, sink.round);
    own(begin + i, sink);
  }
};

/// Reports those of the contacts that come first. Item: a place of the contacts' storage.
struct ReportFirstContacts {
  const StepCounters* counters;
  Span<const TrianglePairContact> contacts;
  AppendView<TrianglePairContact> reported;

  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    if (i < counters->contacts && contacts[i].toi <= horizon_of(*counters, kNarrowRounds)) reported.append(contacts[i]);
  }
};

}  // namespace dismantle::device_code
