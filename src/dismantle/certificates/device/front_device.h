// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/front_results.h"
#include "dismantle/certificates/sweep/triangle_pair_sweep.h"
#include "dismantle/core/result.h"
#include "dismantle/exec/executor.h"

#include <cstddef>
#include <memory>

namespace dismantle {

/// What a device found of fronts.
struct FrontResults {
  Span<const PartResults> parts;  ///< Of each part, front by front.
  Span<const TrianglePairResult>
      leaves;  ///< Of elementary tests, each of the whole motion with the hint that the front has.
};

/// Keeps copies of fronts in a device's memory and computes there what sweeps ask of their certificates and of pairs of
/// nodes. What it says is what the host's kernels say, bit for bit; what it does not say is left to them. So fronts are
/// the same whatever device is asked, and how often.
class FrontDevice {
 public:
  virtual ~FrontDevice() = default;

  /// Checks all certificates of the fronts, looks at the pairs that do not hold and at what they split into, and tests
  /// triangles that these leave. The fronts stay as they are; what changed of them since they were asked for last goes
  /// to the device.
  /// @param to_the_end looks at everything; else at what is found in a few rounds, as the host may need less
  /// @return what holds until the next call
  /// @pre sweeps begun with begin_sweep(); the fronts' trees outlive the device
  virtual FrontResults ask(Span<const FrontQuery<TrianglePairSweep>> fronts, bool to_the_end) = 0;

  /// Separates pairs of nodes of the fronts as boxes, for what merges before a sweep.
  /// @return of each pair; holds until the next call
  /// @pre as ask()
  virtual Span<const NodeSeparation> separate(Span<const FrontQuery<TrianglePairSweep>> fronts,
                                              Span<const MergeCandidate> pairs) = 0;
};

/// What the buffers of a device have room for at first: the pages and failing pairs of a front of some thousand pairs.
inline constexpr std::size_t kFrontDeviceCapacity = 1024;

/// On the CUDA device. Errors: Failed with the reason alone where there is none, or this build has no CUDA.
/// @param capacity that its buffers start with; they grow as needed
Result<std::unique_ptr<FrontDevice>> make_cuda_front_device(std::size_t capacity = kFrontDeviceCapacity);

/// On a device that the threads of an executor play: all that CUDA runs but its copies and launches, where there is no
/// GPU.
std::unique_ptr<FrontDevice> make_emulated_front_device(const Executor& device,
                                                        std::size_t capacity = kFrontDeviceCapacity);

}  // namespace dismantle
