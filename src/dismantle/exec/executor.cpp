// SPDX-License-Identifier: Apache-2.0
#include "dismantle/exec/executor.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <random>
#include <thread>
#include <vector>

namespace dismantle {

struct Executor::Arena {
  explicit Arena(int thread_count) : tasks(thread_count) {
    // oneTBB makes no more workers than the machine has cores unless it is told to.
    if (thread_count > tbb::info::default_concurrency())
      more_threads.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(thread_count));
  }
  std::optional<tbb::global_control> more_threads;
  tbb::task_arena tasks;
};

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
  if (kind_ == ExecutorKind::Threads) arena_ = std::make_shared<Arena>(thread_count_);
}

void Executor::run_chunks(std::size_t count, std::size_t chunk,
                          const std::function<void(std::size_t, std::size_t)>& run) const {
  if (count == 0) return;
  if (kind_ == ExecutorKind::Threads && count > chunk) {
    arena_->tasks.execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, chunk),
                        [&](const tbb::blocked_range<std::size_t>& range) { run(range.begin(), range.end()); });
    });
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
    arena_->tasks.execute([&] { tbb::parallel_sort(keys.begin(), keys.end()); });
  } else {
    std::sort(keys.begin(), keys.end());
  }
}

}  // namespace dismantle
