// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/exec/append_buffer.h"
#include "dismantle/streams/embedded_pairs.h"
#include "dismantle/streams/guarded_pairs.h"
#include "dismantle/streams/moving_streams.h"
#include "dismantle/streams/narrow_phase_kernel.h"

#include <optional>
#include <vector>

namespace dismantle {

/// Input of the narrow phase.
struct NarrowPhaseInput {
  Span<const std::uint64_t> triangle_pairs;         ///< S_t
  const MovingStreams* streams = nullptr;           ///< The step.
  PairRulesView rules;                              ///< The rules of the component pairs.
  ElementaryTest test = ElementaryTest::Certified;  ///< Test of pairs with PairTest::Ordinary.
  const GhostVertices* ghosts = nullptr;            ///< Of all components; never null.
};

/// The contacts that are within kContactWindow of the first one.
std::vector<TrianglePairContact> first_of(Span<const TrianglePairContact> contacts);

/// The narrow phase over S_t, and its results.
class NarrowPhase {
 public:
  /// @param initial_capacity of each append buffer; they grow as needed
  explicit NarrowPhase(std::size_t initial_capacity, AppendLock lock = AppendLock::Local)
      : lock_(lock), contacts_(initial_capacity), intersections_(initial_capacity) {}

  /// Tests all of S_t, in rounds that are each four times as large as all before: once contacts are known, the
  /// certified tests of later rounds end kContactWindow after the first of them. The rounds depend on S_t alone, and so
  /// do the results.
  void run(const NarrowPhaseInput& input, const Executor& executor);

  /// All contacts within kContactWindow of the first one, in no particular order.
  std::vector<TrianglePairContact> first_contacts() const { return first_of(found_); }
  /// The triangle pairs of components in S_i that intersect at the end of the step; in no particular order.
  Span<const std::uint64_t> intersecting() const { return intersecting_; }
  /// Number of continuous tests left by the filters.
  std::size_t tests() const { return tests_; }
  /// Number of rounds repeated because a buffer was full.
  std::size_t replays() const { return replays_; }

 private:
  void run_round(const NarrowPhaseKernel& kernel, const Executor& executor);

  AppendLock lock_;
  AppendBuffer<TrianglePairContact> contacts_;
  AppendBuffer<std::uint64_t> intersections_;
  std::vector<TrianglePairContact> found_;
  std::vector<std::uint64_t> intersecting_;
  std::size_t tests_ = 0;
  std::size_t replays_ = 0;
};

/// The kernel of the narrow phase for the whole step.
NarrowPhaseKernel narrow_phase_kernel(const NarrowPhaseInput& input);

/// The contacts of a component pair that parts within the step, by the certified test over the rest of it: from the
/// first of its times at which the ghost surfaces are apart. In no particular order; nothing if there is no such time.
std::optional<std::vector<TrianglePairContact>> contacts_after(const PartingPair& parting,
                                                               const NarrowPhaseKernel& kernel,
                                                               const Executor& executor);

/// The triangles of a step at its start and end.
StepTriangles step_triangles(const MovingStreams& streams);

/// Contacts as blocking pairs, in the same order.
std::vector<BlockingPair> blocking_pairs(const AssemblyTriangles& streams, Span<const TrianglePairContact> contacts);
/// Those that are within kContactWindow of the first one, ordered by components and faces.
std::vector<BlockingPair> first_of(std::vector<BlockingPair> pairs);

}  // namespace dismantle
