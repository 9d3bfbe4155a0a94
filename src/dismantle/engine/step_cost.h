// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace dismantle {

/// Wall time of the stages of one step [ms], as in the paper's Table 1.
struct StepTimings {
  double vertices = 0;      ///< S_tm -> S_v
  double refit = 0;         ///< S_v -> S_bv, S_bvh
  double front = 0;         ///< S_bvh -> S_f, S_t
  double intersection = 0;  ///< S_t -> results: TID and CCD
  double overall = 0;
};

/// Sizes of the streams of one step.
struct StreamSizes {
  std::size_t front = 0;               ///< S_f
  std::size_t triangle_pairs = 0;      ///< S_t
  std::size_t intersection_pairs = 0;  ///< S_i: component pairs
  std::size_t elementary_tests = 0;    ///< VF and EE tests, or certified triangle-pair tests, that the filters left
  std::size_t answered_tests = 0;      ///< Those of them that a device answered (method `certificates`)
  std::size_t replays = 0;             ///< Times that a stage ran again because its buffer was full
};

}  // namespace dismantle
