// SPDX-License-Identifier: Apache-2.0
#include "bench/paper/machine_load.h"

#include "bench/timing.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace dismantle {
namespace {

TEST(MachineLoad, IsAtLeastTheCoreThatAThreadKeepsBusy) {
  std::atomic<bool> stop{false};
  double worked_ns = 0;
  std::thread worker([&] {
    const bench::Stopwatch watch(bench::thread_ns);
    while (!stop) worked_ns = watch.ns();
  });
  const double busy = busy_cores(0.5);
  stop = true;
  worker.join();
  // Clock ticks are 10 ms; other programs may take the core from the thread.
  EXPECT_GE(busy, 1e-9 * worked_ns / 0.5 - 0.2);
  EXPECT_LE(busy, 1.1 * std::thread::hardware_concurrency());
  EXPECT_FALSE(processor_name().empty());
}

}  // namespace
}  // namespace dismantle
