// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/front_results.h"
#include "dismantle/core/result.h"
#include "dismantle/exec/executor.h"

#include <cstddef>
#include <memory>

namespace dismantle {

/// Keeps copies of fronts in a device's memory and evaluates certificates and pairs of nodes there. Its results equal
/// those of the host's kernels bit for bit, and what it leaves out is computed by these: fronts do not depend on the
/// device, nor on how often it is used.
class FrontDevice {
 public:
  virtual ~FrontDevice() = default;

  /// Checks all certificates of the fronts, examines the pairs that do not hold and what they are split into, and tests
  /// the triangles that remain. The fronts do not change; what has changed of them since the last call is uploaded.
  /// @param exhaustive examines everything; else a few rounds, as the host may need less
  /// @return of each part, front by front; valid until the next call
  /// @pre sweeps made by prepare_sweep(); the fronts' trees outlive the device
  virtual Span<const PartResults> evaluate(Span<const FrontQuery> fronts, bool exhaustive) = 0;

  /// Separates pairs of nodes of the fronts as boxes, for merging before a sweep.
  /// @return of each pair; valid until the next call
  /// @pre as evaluate()
  virtual Span<const NodeSeparation> separate(Span<const FrontQuery> fronts, Span<const MergeCandidate> pairs) = 0;
};

/// Default capacity of a device's buffers: the pages and failing pairs of a front of some thousand pairs.
inline constexpr std::size_t kFrontDeviceCapacity = 1024;

/// The CUDA device. Errors: Failed with the reason alone if there is none, or this build has no CUDA.
/// @param capacity initial size of its buffers; they grow as needed
Result<std::unique_ptr<FrontDevice>> make_cuda_front_device(std::size_t capacity = kFrontDeviceCapacity);

/// Host emulation of the device on the threads of an executor: runs all code of the CUDA device except its copies and
/// launches, without a GPU.
std::unique_ptr<FrontDevice> make_emulated_front_device(const Executor& device,
                                                        std::size_t capacity = kFrontDeviceCapacity);

}  // namespace dismantle
