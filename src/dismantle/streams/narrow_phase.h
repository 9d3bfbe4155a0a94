// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/exec/append_buffer.h"
#include "dismantle/streams/moving_streams.h"
#include "dismantle/streams/narrow_phase_kernel.h"

namespace dismantle {

/// What the narrow phase looks at.
struct NarrowPhaseInput {
  Span<const std::uint64_t> triangle_pairs;  ///< S_t
  const MovingStreams* streams = nullptr;
  PairRulesView rules;
  ElementaryTest test = ElementaryTest::Certified;
  double path_deviation = 0;  ///< [mm]
};

/// Those of the contacts that are within kContactWindow of the first one.
std::vector<TrianglePairContact> first_of(Span<const TrianglePairContact> contacts);

/// Runs the narrow phase over S_t and keeps what it found.
class NarrowPhase {
 public:
  explicit NarrowPhase(std::size_t initial_capacity) : contacts_(initial_capacity), intersections_(initial_capacity) {}

  /// Tests all of S_t. It does so in rounds, each four times as large as all before: once contacts are known, the
  /// certified tests of later rounds look no further than kContactWindow beyond the first of them. The rounds depend on
  /// S_t alone, so results do, too.
  void run(const NarrowPhaseInput& input, const Executor& executor);

  /// Every contact within kContactWindow of the first one; in no particular order: sort before use.
  std::vector<TrianglePairContact> first_contacts() const { return first_of(found_); }
  /// The triangle pairs of components in S_i that intersect at the end of the step; in no particular order.
  Span<const std::uint64_t> intersecting() const { return intersecting_; }
  std::size_t tests() const { return tests_; }
  std::size_t replays() const { return replays_; }

 private:
  void run_round(const NarrowPhaseKernel& kernel, const Executor& executor);

  AppendBuffer<TrianglePairContact> contacts_;
  AppendBuffer<std::uint64_t> intersections_;
  std::vector<TrianglePairContact> found_;
  std::vector<std::uint64_t> intersecting_;
  std::size_t tests_ = 0;
  std::size_t replays_ = 0;
};

/// The contacts of `pairs`, which belong to a component pair that parts at time `from`, over the rest of the step:
/// certified, with the tolerance as allowance. In no particular order.
std::vector<TrianglePairContact> parted_contacts(const NarrowPhaseInput& input, Span<const std::uint64_t> pairs,
                                                 double from, const Executor& executor);

/// The triangles of the step that the streams are at.
StepTriangles step_triangles(const MovingStreams& streams);

/// The contacts by components and faces, in this order.
std::vector<BlockingPair> blocking_pairs(const AssemblyTriangles& streams,
                                                 Span<const TrianglePairContact> contacts);

}  // namespace dismantle
