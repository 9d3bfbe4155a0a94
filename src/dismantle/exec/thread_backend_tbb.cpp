// SPDX-License-Identifier: Apache-2.0
#include "dismantle/exec/thread_backend.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <optional>

namespace dismantle {

namespace {

class TbbBackend final : public ThreadBackend {
 public:
  explicit TbbBackend(int thread_count) : arena_(thread_count) {
    // oneTBB makes no more workers than the machine has cores unless it is told to.
    if (thread_count > tbb::info::default_concurrency())
      more_threads_.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(thread_count));
  }

  void run_chunks(std::size_t count, std::size_t chunk,
                  const std::function<void(std::size_t, std::size_t)>& run) const override {
    arena_.execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, chunk),
                        [&](const tbb::blocked_range<std::size_t>& range) { run(range.begin(), range.end()); });
    });
  }
  void sort(Span<std::uint64_t> keys) const override {
    arena_.execute([&] { tbb::parallel_sort(keys.begin(), keys.end()); });
  }

 private:
  std::optional<tbb::global_control> more_threads_;
  mutable tbb::task_arena arena_;
};

}  // namespace

std::shared_ptr<const ThreadBackend> make_thread_backend(int thread_count) {
  return std::make_shared<TbbBackend>(thread_count);
}

}  // namespace dismantle
