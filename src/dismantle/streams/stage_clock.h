// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace dismantle {

/// A clock for the stages of a step.
class StageClock {
 public:
  /// The wall time since the last lap, or since construction [ms].
  double lap() {
    const Clock::time_point now = Clock::now();
    const double ms = milliseconds(now - last_);
    last_ = now;
    return ms;
  }
  /// The wall time since construction [ms].
  double total() const { return milliseconds(Clock::now() - start_); }

 private:
  using Clock = std::chrono::steady_clock;
  static double milliseconds(Clock::duration d) { return std::chrono::duration<double, std::milli>(d).count(); }

  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

}  // namespace dismantle
