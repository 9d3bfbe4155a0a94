// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/core/span.h"
#include "dismantle/exec/executor.h"
#include "dismantle/front/certificate_kernels.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace dismantle {

class CertificateFront;

/// What a device found of a pair of nodes that a sweep has to look at.
struct PairAnswer {
  enum Kind : std::uint32_t {
    None,       ///< It did not look at the pair: the host does.
    Boxes,      ///< What is in `separation` certifies them as boxes.
    Split,      ///< They are not apart as boxes; of the halves of the larger one is more known.
    Triangles,  ///< Neither are they as boxes, and `separation` is that of their triangles.
  };
  static constexpr std::uint32_t kNone = 0xffffffffu;

  Kind kind = None;
  std::uint32_t part = 0;             ///< Of those that were asked for, and of a pair of the front
  std::uint32_t place = kNone;        ///< its place in that; none of what pairs were split into.
  std::uint32_t first_child = kNone;  ///< Of two answers; none where there was no room for them.
  NodeSeparation separation = {};
};

/// What a device found of one part of a front.
struct PartAnswers {
  float least_gap = 3e38f;           ///< As CertificateCheck has it.
  std::vector<std::uint32_t> roots;  ///< Answers of the pairs that do not hold, their places ascending.
  Span<const PairAnswer> answers;    ///< Of all parts.
};

/// A front whose parts are swept.
struct AskedFront {
  CertificateFront* front;
  const LinearSweep* sweep;
};

/// Keeps copies of fronts in a device's memory and computes there what sweeps ask of their certificates and of pairs of
/// nodes. What it says is what the host's kernels say, bit for bit; what it does not say is left to them. So fronts are
/// the same whatever device is asked, and how often.
class FrontDevice {
 public:
  virtual ~FrontDevice() = default;

  /// Checks all certificates of the fronts, and looks at the pairs that do not hold and at what they split into. The
  /// fronts stay as they are; what changed of them since they were asked for last goes to the device.
  /// @param to_the_end looks at everything; else at what is found in a few rounds, as the host may need less
  /// @return of each part, front by front; holds until the next call
  /// @pre sweeps begun with begin_sweep(); the fronts' trees outlive the device
  virtual Span<const PartAnswers> ask(Span<const AskedFront> fronts, bool to_the_end) = 0;
};

/// What the buffers of a device have room for at first: the pages and failing pairs of a front of some thousand pairs.
inline constexpr std::size_t kFrontDeviceCapacity = 1024;

/// On the CUDA device. Errors: Failed with the reason alone where there is none, or this build has no CUDA.
/// @param capacity that its buffers start with; they grow as needed
Result<std::unique_ptr<FrontDevice>> make_cuda_front_device(std::size_t capacity = kFrontDeviceCapacity);

/// On a device that the threads of an executor play: all that CUDA runs but its copies and launches, where there is no
/// GPU.
std::unique_ptr<FrontDevice> make_played_front_device(const Executor& device,
                                                      std::size_t capacity = kFrontDeviceCapacity);

}  // namespace dismantle
