// SPDX-License-Identifier: Apache-2.0
#include "dismantle/exec/thread_backend.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace dismantle {

namespace {

/// Starts new threads for every run: slow, but transparent to ThreadSanitizer.
class StdThreadBackend final : public ThreadBackend {
 public:
  explicit StdThreadBackend(int thread_count) : thread_count_(thread_count) {}

  void run_chunks(std::size_t count, std::size_t chunk,
                  const std::function<void(std::size_t, std::size_t)>& run) const override {
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
      for (std::size_t begin = next.fetch_add(chunk); begin < count; begin = next.fetch_add(chunk))
        run(begin, std::min(begin + chunk, count));
    };
    std::vector<std::thread> threads;
    for (int i = 1; i < thread_count_; ++i) threads.emplace_back(work);
    work();
    for (std::thread& thread : threads) thread.join();
  }
  void sort(Span<std::uint64_t> keys) const override { std::sort(keys.begin(), keys.end()); }

 private:
  int thread_count_;
};

}  // namespace

std::shared_ptr<const ThreadBackend> make_thread_backend(int thread_count) {
  return std::make_shared<StdThreadBackend>(thread_count);
}

}  // namespace dismantle
