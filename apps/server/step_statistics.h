// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dismantle::server {

/// The last 4096 values of a series of measurements.
class RecentValues {
 public:
  /// Adds a value; replaces the oldest one if there are 4096.
  void add(double value) { values_[count_++ % values_.size()] = value; }
  /// The quantile `q`, from 0 (minimum) to 1 (maximum); 0 if there are no values.
  double quantile(double q) const {
    std::vector<double> sorted(values_.begin(), values_.begin() + static_cast<std::ptrdiff_t>(size()));
    if (sorted.empty()) return 0;
    const auto place = sorted.begin() + std::lround(q * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), place, sorted.end());
    return *place;
  }

 private:
  std::size_t size() const { return std::min(count_, values_.size()); }

  std::array<double, 4096> values_{};
  std::size_t count_ = 0;
};

/// Statistics of the engine loop's steps. For the loop's thread.
class StepStatistics {
 public:
  /// The clock of the rates.
  using Clock = std::chrono::steady_clock;

  /// Adds a step, which ended at `now`, and its duration [us].
  void add_step(double microseconds, Clock::time_point now) {
    step_us_.add(microseconds);
    ++steps_;
    ++in_this_second_;
    roll(now);
  }
  /// Adds the time from the arrival of a target to the pose that results from it [us].
  void add_latency(double microseconds) { latency_us_.add(microseconds); }

  /// Number of steps so far.
  std::uint64_t steps() const { return steps_; }
  /// Durations of the last steps [us].
  const RecentValues& step_us() const { return step_us_; }
  /// The last times from a target's arrival to the resulting pose [us].
  const RecentValues& latency_us() const { return latency_us_; }
  /// Steps in the last complete second.
  double steps_per_second(Clock::time_point now) {
    roll(now);
    return per_second_;
  }

 private:
  void roll(Clock::time_point now) {
    const double passed = std::chrono::duration<double>(now - second_began_).count();
    if (passed < 1) return;
    per_second_ = passed < 2 ? in_this_second_ / passed : 0;
    in_this_second_ = 0;
    second_began_ = now;
  }

  RecentValues step_us_, latency_us_;
  std::uint64_t steps_ = 0;
  double in_this_second_ = 0, per_second_ = 0;
  Clock::time_point second_began_ = Clock::now();
};

}  // namespace dismantle::server
