// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/engine/motion_engine.h"
#include "dismantle/streams/narrow_phase.h"
#include "dismantle/streams/streams_motion_engine.h"

#include <memory>
#include <vector>

namespace dismantle {

/// What the streams gave in one step.
struct StreamsStep {
  std::vector<TrianglePairContact> contacts;  ///< Those within kContactWindow of the first; in no particular order.
  /// The triangle pairs of components in S_i that intersect at the end of the step; in no particular order.
  std::vector<std::uint64_t> intersecting;
  StageTimings timings;  ///< Of the stages; not overall.
  StreamSizes sizes;    ///< Without intersection_pairs.
};

/// Where the streams of Du et al. 2015 are kept and worked on: algorithm 1 but for what it says about pairs that part.
/// Every backend gives the same contacts and intersections, bit for bit.
class StreamsBackend {
 public:
  virtual ~StreamsBackend() = default;

  /// From now on pairs are tested by these rules. To be called before the first step; what `rules` is a view of must
  /// not change before the next call.
  virtual void set_rules(PairRulesView rules) = 0;
  /// The motion from the current state to `next`; the state stays as it is.
  virtual StreamsStep step(Span<const RigidTransform> next, double path_deviation) = 0;
  /// The last step's next state becomes the current one.
  virtual void commit() = 0;
  virtual void jump(Span<const RigidTransform> state) = 0;
  virtual Span<const RigidTransform> state() const = 0;

  /// What stays the same from step to step, on the host.
  virtual const AssemblyTriangles& fixed() const = 0;
  /// S_t of the last step on the host: keys, ascending. It may have to be brought there.
  virtual Span<const std::uint64_t> triangle_pairs() = 0;
  /// The streams of the last step, or after a jump those of the state, on the host. They may have to be made there.
  virtual const MovingStreams& on_host() = 0;
};

/// On the threads of the options' executor.
std::unique_ptr<StreamsBackend> make_host_streams_backend(const Assembly& assembly, const CollisionOptions& options);

/// On the CUDA device. Errors: Failed with the reason alone where there is none, this build has no CUDA, or the streams
/// do not fit into its memory.
Result<std::unique_ptr<StreamsBackend>> make_cuda_streams_backend(const Assembly& assembly,
                                                                  const CollisionOptions& options);

/// On a device that the threads of an executor play: all that CUDA runs but its copies and launches, where there is no
/// GPU.
std::unique_ptr<StreamsBackend> make_device_streams_backend(const Assembly& assembly, const CollisionOptions& options,
                                                            const Executor& device);

/// The paper's method over any backend of the same assembly, all components in the assembled state.
std::unique_ptr<SweepEngine> make_streams_engine(const Assembly& assembly, const PairStates& pairs,
                                                 const CollisionOptions& options,
                                                 std::unique_ptr<StreamsBackend> backend);
/// The same with responses Stop and Touch. The assembly must outlive the engine.
std::unique_ptr<MotionEngine> make_streams_motion_engine(const Assembly& assembly, const PairStates& pairs,
                                                         const CollisionOptions& options,
                                                         std::unique_ptr<StreamsBackend> backend);

}  // namespace dismantle
