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

/// The last so many of a series of measurements.
class RecentValues {
 public:
  void add(double value) { values_[count_++ % values_.size()] = value; }
  /// The value below which the share `q` of them lies; 0 where there are none.
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

/// The cost of the engine loop's steps.
class StepStatistics {
 public:
  using Clock = std::chrono::steady_clock;

  void add_step(double microseconds, Clock::time_point now) {
    step_us_.add(microseconds);
    ++steps_;
    ++in_this_second_;
    roll(now);
  }
  /// From a target's arrival to the pose that answers it.
  void add_answer(double microseconds) { hand_to_pose_us_.add(microseconds); }

  std::uint64_t steps() const { return steps_; }
  const RecentValues& step_us() const { return step_us_; }
  const RecentValues& hand_to_pose_us() const { return hand_to_pose_us_; }
  /// In the last whole second.
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

  RecentValues step_us_, hand_to_pose_us_;
  std::uint64_t steps_ = 0;
  double in_this_second_ = 0, per_second_ = 0;
  Clock::time_point second_began_ = Clock::now();
};

}  // namespace dismantle::server
