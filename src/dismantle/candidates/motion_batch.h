// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/assembly/path.h"
#include "dismantle/core/result.h"
#include "dismantle/core/span.h"
#include "dismantle/engine/contact.h"
#include "dismantle/engine/device_choice.h"
#include "dismantle/exec/cuda_device.h"
#include "dismantle/exec/executor.h"

#include <memory>
#include <string>
#include <vector>

namespace dismantle {

/// First contacts of many candidate motions of one rigid set from one state, independent of each other. One thread
/// computes one candidate, on the CPU or on a CUDA device, with the same bits for every device, number of threads and
/// order of the candidates.
///
/// Guarantee: at no instant before the `toi` of a candidate does a ghost surface of a pair cross the other component
/// (docs/guarantee.md); this holds for the true screw. Free pairs are free all the way, and so are those for which no
/// ghosts were found: their depth is bounded by MotionEngine::step() only.
class MotionBatch {
 public:
  virtual ~MotionBatch() = default;

  /// Sets the pose of every component, shape [component_count], and the components that move as one body.
  /// @pre `moving` is not empty, without repeats, all at one pose
  virtual void set_state(Span<const Pose> poses, Span<const ComponentId> moving) = 0;
  /// The first contacts of translations from that state [mm, world]. @pre set_state was called
  virtual std::vector<FirstContact> straight_contacts(Span<const Vec3> displacements) = 0;
  /// The first contacts of the screws from that state to these poses of the set. @pre set_state was called
  virtual std::vector<FirstContact> screw_contacts(Span<const Pose> targets) = 0;
};

/// A batch and the device that it runs on.
struct ChosenMotionBatch {
  std::unique_ptr<MotionBatch> batch;  ///< Ready for set_state().
  std::string device;                  ///< "cpu", or the CUDA device's name.
  std::string why;                     ///< DeviceChoice::Cuda: the reason for running on the CPU instead; else empty.
  /// Says if the device failed later and the CPU took over; null on the CPU.
  std::shared_ptr<const DeviceFailure> failure;
};

/// Makes a batch for an assembly, which must outlive it. DeviceChoice::Auto takes a CUDA device if there is one.
ChosenMotionBatch make_motion_batch(const Assembly& assembly, const PairStates& pairs, const Executor& executor,
                                    DeviceChoice choice);

/// Makes a batch on the CUDA device. Errors: Failed with the reason alone if there is none, this build has no CUDA, or
/// the assembly does not fit into its memory.
Result<std::unique_ptr<MotionBatch>> make_cuda_motion_batch(const Assembly& assembly, const PairStates& pairs,
                                                            const Executor& executor);

}  // namespace dismantle
