// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/plan_time.h"

#include <gtest/gtest.h>

#include <thread>

namespace dismantle {
namespace {

/// Waits until a plan has taken this long [s].
void wait_until(const PlanTime& time, double seconds) {
  while (time.seconds() < seconds) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST(PlanTime, HasNoEndWithoutALimit) {
  PlanTime time(0);
  wait_until(time, 0.01);
  EXPECT_TRUE(time.is_left());
  time.begin_order();
  EXPECT_TRUE(time.is_left());
  time.begin_reasons();
  EXPECT_TRUE(time.is_left());
  EXPECT_FALSE(time.has_run_out());
}

TEST(PlanTime, LeavesSomeTimeForOrderAndReasonsAfterStepsHaveRunOut) {
  PlanTime time(1e9);
  EXPECT_TRUE(time.is_left());
  PlanTime none(1e-9);
  EXPECT_FALSE(none.is_left());
  EXPECT_TRUE(none.is_over());
  PlanTime shared(0.5);
  wait_until(shared, 0.43);
  EXPECT_FALSE(shared.is_left()) << "the rest is for order and reasons";
  shared.begin_order();
  EXPECT_FALSE(shared.is_over());
  EXPECT_TRUE(shared.has_run_out()) << "some steps were not sought";
  wait_until(shared, 0.465);
  EXPECT_FALSE(shared.is_left());
  shared.begin_reasons();
  EXPECT_TRUE(shared.is_left());
  EXPECT_TRUE(shared.has_run_out());
  wait_until(shared, 0.51);
  EXPECT_FALSE(shared.is_left());
}

TEST(PlanTime, SeeksNoReasonsAfterItWasCancelled) {
  PlanTime time(0);
  time.cancel();
  EXPECT_FALSE(time.is_left());
  time.begin_order();
  EXPECT_FALSE(time.is_left());
  time.begin_reasons();
  EXPECT_FALSE(time.is_left());
  EXPECT_TRUE(time.has_run_out());
}

}  // namespace
}  // namespace dismantle
