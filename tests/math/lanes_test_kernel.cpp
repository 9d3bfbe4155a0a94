// SPDX-License-Identifier: Apache-2.0
#include "tests/math/lanes_test_kernel.h"

#include "tests/math/lanes_test_run.h"

namespace dismantle {

template <>
void lanes_test_kernel<DISMANTLE_LANE_COUNT>(const LaneOperands& operands, LaneResults* results) {
  run_lane_operations<DISMANTLE_LANE_COUNT, LaneOperations<DISMANTLE_LANE_COUNT>>(operands, results);
}

}  // namespace dismantle
