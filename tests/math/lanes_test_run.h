// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/lanes.h"
#include "tests/math/lanes_test_kernel.h"

namespace dismantle {
inline namespace DISMANTLE_LANES_ISA {

template <int kCount, class Operations>
void run_lane_operations(const LaneOperands& operands, LaneResults* results) {
  using L = Lanes<kCount, Operations>;
  for (int start = 0; start < operands.count; start += kCount) {
    const L a = L::load(operands.a + start), b = L::load(operands.b + start), c = L::load(operands.c + start);
    const L numbers[LaneResults::kNumbers] = {a + b,
                                              a - b,
                                              a * b,
                                              a / b,
                                              -a,
                                              min(a, b),
                                              max(a, b),
                                              abs(a),
                                              sqrt(a),
                                              select(a < b, a, c),
                                              L(operands.a[start]),
                                              a * b + c};
    const typename L::Mask truths[7] = {a<b, a <= b, a> b, a >= b, a == b, (a < b) & (b < c), (a < b) | !(b < c)};
    for (int k = 0; k < LaneResults::kNumbers; ++k) {
      float out[kCount];
      numbers[k].store(out);
      for (int i = 0; i < kCount; ++i) results[start + i].number[k] = out[i];
    }
    for (int k = 0; k < 7; ++k)
      for (int i = 0; i < kCount; ++i) results[start + i].truth[k] = (bits(truths[k]) >> i & 1) != 0;
    for (int i = 0; i < kCount; ++i) {
      results[start + i].truth[7] = any(truths[0]);
      results[start + i].truth[8] = all(truths[0]);
    }
  }
}

}  // namespace DISMANTLE_LANES_ISA
}  // namespace dismantle
