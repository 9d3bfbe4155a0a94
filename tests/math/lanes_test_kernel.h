// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dismantle {

/// The results of every lane operation for triples of floats.
struct LaneResults {
  static constexpr int kNumbers = 12;
  static constexpr int kTruths = 9;

  float number[kNumbers];
  bool truth[kTruths];
};

/// Operands, one array each. Shape of all: [count]; the count is a multiple of 16.
struct LaneOperands {
  const float *a, *b, *c;
  int count;
};

/// Runs every operation with kLanes lanes. `results` has shape [count].
template <int kLanes>
void lanes_test_kernel(const LaneOperands& operands, LaneResults* results);

/// The same with the compiler's vectors of four, as used on machines other than x86.
void lanes_test_portable(const LaneOperands& operands, LaneResults* results);

}  // namespace dismantle
