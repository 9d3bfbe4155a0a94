// SPDX-License-Identifier: Apache-2.0
#include "dismantle/exec/executor.h"

#include "dismantle/exec/thread_backend.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <thread>
#include <vector>

namespace dismantle {

namespace {

int resolved_thread_count(ExecutorKind kind, int wanted) {
  if (kind != ExecutorKind::Threads) return 1;
  if (wanted > 0) return wanted;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace

Executor::Executor() : Executor(ExecutorKind::Serial) {}

Executor::Executor(ExecutorKind kind, int thread_count)
    : kind_(kind), thread_count_(resolved_thread_count(kind, thread_count)) {
  if (kind_ == ExecutorKind::Threads) threads_ = make_thread_backend(thread_count_);
}

void Executor::run_chunks(std::size_t count, std::size_t chunk,
                          const std::function<void(std::size_t, std::size_t)>& run) const {
  if (count == 0) return;
  if (kind_ == ExecutorKind::Threads && count > chunk) {
    threads_->run_chunks(count, chunk, run);
    return;
  }
  if (kind_ == ExecutorKind::Shuffled) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), std::mt19937_64(count));
    for (const std::size_t i : order) run(i, i + 1);
    return;
  }
  run(0, count);
}

void Executor::sort(Span<std::uint64_t> keys) const {
  if (kind_ == ExecutorKind::Threads) {
    threads_->sort(keys);
  } else {
    std::sort(keys.begin(), keys.end());
  }
}

}  // namespace dismantle
