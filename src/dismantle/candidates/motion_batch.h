// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/streams/choose_streams_backend.h"

#include <memory>
#include <vector>

namespace dismantle {

/// Many candidate motions of one rigid set from one state, each by itself: what a planner asks for. A candidate is one
/// thread's work, on the CPU or a CUDA device: the same bits on both, whatever the threads and the other candidates.
/// (CertificateEngine::first_contacts answers the same from certificates, on the CPU only.)
///
/// Guarantee: at no instant before a candidate's `toi` are two triangles deeper in each other than their pair is
/// allowed (docs/guarantee.md, first rule); this holds for the true screw. Embedded pairs are free all the way.
class MotionBatch {
 public:
  virtual ~MotionBatch() = default;

  /// Where everything is, one pose a component, and which of them go their candidates' ways as one.
  /// @pre `moving` is not empty, without repeats, all at one pose
  virtual void set_state(Span<const Pose> poses, Span<const ComponentId> moving) = 0;
  /// The first contacts of straight ways from there [mm]. @pre set_state was called
  virtual std::vector<FirstContact> straight_contacts(Span<const Vec3> ways) = 0;
  /// The first contacts of screws from there to these poses of the set. @pre set_state was called
  virtual std::vector<FirstContact> screw_contacts(Span<const Pose> targets) = 0;
};

struct ChosenMotionBatch {
  std::unique_ptr<MotionBatch> batch;
  std::string device;  ///< As in ChosenStreamsBackend.
  std::string why;
};

/// Candidates of an assembly, which must outlive the batch. Auto takes a CUDA device wherever there is one.
ChosenMotionBatch make_motion_batch(const Assembly& assembly, const PairStates& pairs, const Executor& executor,
                                    DeviceChoice choice);

/// On the CUDA device. Errors: as make_cuda_streams_backend.
Result<std::unique_ptr<MotionBatch>> make_cuda_motion_batch(const Assembly& assembly, const PairStates& pairs,
                                                            const Executor& executor);

}  // namespace dismantle
