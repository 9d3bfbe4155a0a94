// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/engine/motion_engine.h"
#include "dismantle/streams/narrow_phase.h"
#include "dismantle/streams/streams_motion_engine.h"

#include <memory>
#include <vector>

namespace dismantle {

/// The output of the streams in one step.
struct StreamsStep {
  std::vector<TrianglePairContact> contacts;  ///< Within kContactWindow of the first one; in no particular order.
  /// The triangle pairs of components in S_i that intersect at the end of the step; in no particular order.
  std::vector<std::uint64_t> intersecting;
  StageTimings timings;  ///< Without `overall`.
  StreamSizes sizes;     ///< Without `intersection_pairs`.
};

/// Memory and processor of the streams of Du et al. 2015: algorithm 1 except for pairs that part. Every backend gives
/// the same contacts and intersections, bit for bit.
class StreamsBackend {
 public:
  virtual ~StreamsBackend() = default;

  /// Sets the ghost surfaces, which must outlive this. To be called once, before the first step.
  virtual void set_ghosts(const GhostVertices& ghosts) = 0;
  /// Sets the rules by which pairs are tested. To be called before the first step; the table of `rules` must not change
  /// before the next call.
  virtual void set_rules(PairRulesView rules) = 0;
  /// Sweeps the motion from the current state to `next`, one transform a component; the state does not change.
  virtual StreamsStep step(Span<const RigidTransform> next) = 0;
  /// Makes the `next` of the last step the current state.
  virtual void commit() = 0;
  /// Sets the current state without a test, one transform a component.
  virtual void jump(Span<const RigidTransform> state) = 0;
  /// The current state, one transform a component.
  virtual Span<const RigidTransform> state() const = 0;

  /// The data that stays the same from step to step, on the host.
  virtual const AssemblyTriangles& fixed() const = 0;
  /// S_t of the last step on the host: keys, ascending. May have to be downloaded.
  virtual Span<const std::uint64_t> triangle_pairs() = 0;
  /// The streams of the last step, or after a jump those of the state, on the host. May have to be computed there.
  virtual const MovingStreams& on_host() = 0;
};

/// Makes a backend on the threads of the options' executor. @param assembly must outlive it
std::unique_ptr<StreamsBackend> make_host_streams_backend(const Assembly& assembly, const CollisionOptions& options);

/// Makes a backend on the CUDA device. Errors: Failed with the reason alone if there is none, this build has no CUDA,
/// or the streams do not fit into its memory.
Result<std::unique_ptr<StreamsBackend>> make_cuda_streams_backend(const Assembly& assembly,
                                                                  const CollisionOptions& options);

/// Makes a backend on a host emulation of a device: all code that CUDA runs, except copies and launches, on the threads
/// of an executor. For tests without a GPU.
std::unique_ptr<StreamsBackend> make_emulated_streams_backend(const Assembly& assembly, const CollisionOptions& options,
                                                              const Executor& device);

/// Makes the paper's method over any backend of the same assembly, with all components in the assembled state.
std::unique_ptr<SweepEngine> make_streams_engine(const Assembly& assembly, const PairStates& pairs,
                                                 const CollisionOptions& options,
                                                 std::unique_ptr<StreamsBackend> backend);
/// The same as a MotionEngine with responses Stop and Touch. @param assembly must outlive the engine
std::unique_ptr<MotionEngine> make_streams_motion_engine(const Assembly& assembly, const PairStates& pairs,
                                                         const CollisionOptions& options,
                                                         std::unique_ptr<StreamsBackend> backend);

}  // namespace dismantle
