// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <time.h>

#include <algorithm>
#include <cmath>
#include <vector>

/// Clocks of the benchmarks, and what their tables say of many times.
namespace dismantle::bench {

/// A clock's time [ns], from any fixed moment on.
using ClockNs = double (*)();

/// Time of a clock of the system [ns].
inline double clock_ns(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
}
/// Wall time [ns].
inline double wall_ns() {
  return clock_ns(CLOCK_MONOTONIC);
}
/// Processor time of this thread [ns]: other work on the machine does not lengthen it much.
inline double thread_ns() {
  return clock_ns(CLOCK_THREAD_CPUTIME_ID);
}
/// Processor time of all threads of this program [ns].
inline double process_ns() {
  return clock_ns(CLOCK_PROCESS_CPUTIME_ID);
}

/// The time since it was made, by one of the clocks.
class Stopwatch {
 public:
  explicit Stopwatch(ClockNs now = wall_ns) : now_(now), start_(now()) {}
  double ns() const { return now_() - start_; }
  double us() const { return 1e-3 * ns(); }
  double ms() const { return 1e-6 * ns(); }
  double seconds() const { return 1e-9 * ns(); }

 private:
  ClockNs now_;
  double start_;
};

/// Keeps the compiler from leaving out or merging what computes the value.
template <class T>
void keep(T& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

/// The time of `run` [ns]: the fastest of `passes` after one that warms up, since other programs can only lengthen it.
template <class Run>
double fastest_ns(int passes, const Run& run, ClockNs now = wall_ns) {
  double fastest = 0;
  for (int pass = 0; pass <= passes; ++pass) {
    const Stopwatch watch(now);
    run();
    const double ns = watch.ns();
    if (pass == 1 || (pass > 1 && ns < fastest)) fastest = ns;
  }
  return fastest;
}

/// The arithmetic mean; 0 of no values.
inline double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

/// The q-th quantile: the smallest value that at least the share q of the values does not exceed (nearest rank); 0 of
/// no values. @pre 0 <= q <= 1
template <class Value>
double quantile(std::vector<Value> values, double q) {
  if (values.empty()) return 0;
  const double rank = std::ceil(q * static_cast<double>(values.size()));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::max(1.0, rank)) - 1;
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace dismantle::bench
