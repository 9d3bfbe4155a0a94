// SPDX-License-Identifier: Apache-2.0
#include "dismantle/exec/thread_backend.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace dismantle {

namespace {

/// Standard threads that wait for runs. A run that begins while another one has the threads is done by its caller.
class StdThreadBackend final : public ThreadBackend {
 public:
  explicit StdThreadBackend(int thread_count) {
    for (int i = 1; i < thread_count; ++i) threads_.emplace_back([this] { wait_for_runs(); });
  }
  ~StdThreadBackend() override {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    run_begins_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

  void run_chunks(std::size_t count, std::size_t chunk,
                  const std::function<void(std::size_t, std::size_t)>& run) const override {
    Run mine{count, chunk, &run};
    if (threads_.empty() || count <= chunk || in_use_.exchange(true, std::memory_order_acquire)) {
      mine.work();
      return;
    }
    {
      const std::lock_guard lock(mutex_);
      run_ = &mine;
      ++run_number_;
      busy_ = threads_.size();
    }
    run_begins_.notify_all();
    mine.work();
    std::unique_lock lock(mutex_);
    run_ends_.wait(lock, [this] { return busy_ == 0; });
    run_ = nullptr;
    in_use_.store(false, std::memory_order_release);
  }
  void sort(Span<std::uint64_t> keys) const override { std::sort(keys.begin(), keys.end()); }

 private:
  struct Run {
    std::size_t count, chunk;
    const std::function<void(std::size_t, std::size_t)>* run;
    std::atomic<std::size_t> next{0};

    void work() {
      for (std::size_t begin = next.fetch_add(chunk); begin < count; begin = next.fetch_add(chunk))
        (*run)(begin, std::min(begin + chunk, count));
    }
  };

  void wait_for_runs() {
    std::size_t done = 0;
    for (std::unique_lock lock(mutex_);;) {
      run_begins_.wait(lock, [&] { return stopping_ || run_number_ != done; });
      if (stopping_) return;
      done = run_number_;
      Run* const current = run_;
      lock.unlock();
      current->work();
      lock.lock();
      if (--busy_ == 0) run_ends_.notify_one();
    }
  }

  std::vector<std::thread> threads_;
  mutable std::atomic<bool> in_use_{false};  // the threads, by a run
  mutable std::mutex mutex_;                 // of what follows
  mutable std::condition_variable run_begins_, run_ends_;
  mutable Run* run_ = nullptr;
  mutable std::size_t run_number_ = 0, busy_ = 0;
  bool stopping_ = false;
};

}  // namespace

std::shared_ptr<const ThreadBackend> make_thread_backend(int thread_count) {
  return std::make_shared<StdThreadBackend>(thread_count);
}

}  // namespace dismantle
