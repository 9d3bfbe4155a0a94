// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>

namespace dismantle {

/// The time of a plan, from its start: most of the limit is for steps, the rest for their order and for the reasons why
/// components stay.
class PlanTime {
 public:
  /// @param limit [s]; 0 for none
  explicit PlanTime(double limit) : limit_(limit), end_(kShareOfSteps * limit) {}

  /// Since the start [s].
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  /// False once time is up, or the plan was cancelled. Thread-safe.
  bool is_left() {
    if (end_ > 0 && seconds() > end_) is_up_ = true;
    return !is_over();
  }
  /// Ends the plan. Thread-safe.
  void cancel() { is_cancelled_ = true; }
  /// True if the plan was cancelled or a call of is_left() found that time is up.
  bool is_over() const { return is_up_ || is_cancelled_; }
  /// Ends the time for steps; that for their order begins. @pre no other thread uses this
  void begin_order() {
    has_missed_steps_ = is_over();
    end_ = kShareOfOrder * limit_;
    is_up_ = false;
  }
  /// Reasons may take what is left of the limit. @pre no other thread uses this
  void begin_reasons() {
    end_ = limit_;
    is_up_ = false;
  }
  /// True if the search for steps ended early, or what is done now did.
  bool has_run_out() const { return has_missed_steps_ || is_over(); }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr double kShareOfSteps = 0.85, kShareOfOrder = 0.92;  // up to its end

  Clock::time_point start_ = Clock::now();
  double limit_, end_;
  std::atomic<bool> is_up_ = false, is_cancelled_ = false;
  bool has_missed_steps_ = false;
};

}  // namespace dismantle
