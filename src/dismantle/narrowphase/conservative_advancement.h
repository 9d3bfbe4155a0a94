// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/narrowphase/separating_axis.h"

namespace dismantle {

/// A step that advances by less than this part of the motion counts as no progress.
inline constexpr double kMinProgress = 0x1p-26;

/// Limits after which a test reports contact at the time that it has reached. Any values are safe: they make contacts
/// earlier, never later.
struct AdvancementLimits {
  int steps = 64;                      ///< Largest number of steps.
  double min_progress = kMinProgress;  ///< Smallest advance of a step, as a part of the motion.
};

/// Result of a certified test with its last axis, the hint for the pair's next motion.
struct AxisCcdResult {
  CcdResult ccd;  ///< Result and cost.
  /// Points from A to B, of any length. It separates the pair up to `toi`; zero where no axis does.
  Vec3 axis;
};

/// An axis to try, from a pair of closest points.
struct AxisGuess {
  Vec3 axis;              ///< From A to B, of any length.
  bool interior = false;  ///< The points are in the interiors of both features.
};

/// The axis tried that separates for the longest time, of those that separate at the current time.
///   1. Up to end() the pair is certainly separated along axis(), by the allowance.
///   2. The axis of the last step (the guard) is only replaced by one within a right angle of it, or by one that
///   separates
///      without the allowance; where the guard itself uses the allowance, by a gap of more than the allowance.
///      Otherwise two faces, which have no thickness, could pass through each other.
template <int kCountA, int kCountB>
class FurthestAxis {
 public:
  /// @param hulls must outlive this; @param allowed [mm], >= 0; @param hint the first guard; zero for none
  DISMANTLE_HOST_DEVICE FurthestAxis(const RelativeHulls<kCountA, kCountB>& hulls, double allowed, Vec3 hint)
      : hulls_(hulls), allowed_(allowed), axis_(hint) {
    start(0);
  }

  /// Begins a step at the time `now`, up to which axis() separates.
  DISMANTLE_HOST_DEVICE void start(double now) {
    now_ = now;
    end_ = -1;
    if (!(allowed_ > 0)) return;
    guard_ = axis_;
    guard_checked_ = false;
  }

  /// Tries an axis that points from A to B, of any length.
  DISMANTLE_HOST_DEVICE void consider(Vec3 w) {
    const AxisProjections<kCountA, kCountB> projections(hulls_, w, allowed_);
    if (projections.separates_throughout()) {
      if (!refused(w)) keep(w, 1);
    } else {
      keep_if_further(projections, w);
    }
  }

  /// Tries an axis in both directions.
  DISMANTLE_HOST_DEVICE void consider_both_signs(Vec3 w) {
    AxisProjections<kCountA, kCountB> projections(hulls_, w, allowed_);
    keep_if_further(projections, w);
    projections.turn();
    keep_if_further(projections, -w);
  }

  /// The best axis so far; that of the last step, or the hint, where this step has none.
  DISMANTLE_HOST_DEVICE Vec3 axis() const { return axis_; }
  /// The time up to which the best axis of this step certainly separates; below `now` where none does.
  DISMANTLE_HOST_DEVICE double end() const { return end_; }

 private:
  DISMANTLE_HOST_DEVICE void keep_if_further(const AxisProjections<kCountA, kCountB>& projections, Vec3 w) {
    const double until = projections.separates_until(now_);
    if (until > end_ && !refused(w)) keep(w, until);
  }

  DISMANTLE_HOST_DEVICE void keep(Vec3 w, double until) {
    end_ = until;
    axis_ = w;
  }

  /// True if the guard forbids an axis. How the guard separates is computed when it is first needed.
  DISMANTLE_HOST_DEVICE bool refused(Vec3 w) {
    if (!(dot(w, guard_) < 0)) return false;
    if (!guard_checked_) {
      guard_checked_ = true;
      guard_apart_ = separates_now(guard_, 0);
      // Twice the allowance: rounding must not release a guard that has used its allowance up to the last bit.
      if (!guard_apart_ && !separates_now(guard_, 2 * allowed_)) guard_ = {};
    }
    return dot(w, guard_) < 0 && !separates_now(w, guard_apart_ ? 0 : -allowed_);
  }

  [[gnu::noinline]] DISMANTLE_HOST_DEVICE bool separates_now(Vec3 w, double allowed) const {
    return AxisProjections<kCountA, kCountB>(hulls_, w, allowed).separates_until(now_) >= now_;
  }

  const RelativeHulls<kCountA, kCountB>& hulls_;
  double allowed_;
  double now_ = 0, end_ = -1;
  Vec3 axis_;
  Vec3 guard_;  ///< The last step's axis; zero for none.
  bool guard_checked_ = false, guard_apart_ = false;
};

/// Conservative advancement (docs/design/0001-certified-ccd.md; after Mirtich 1996, and Catto's time of impact): from
/// the time up to which the motion is certainly free, jumps to the end of the best certificate, until one lasts to the
/// end of the motion (Free) or none makes progress (Contact).
///   1. Free is certain; the motion is certainly free on [0, toi). Both hold whatever axes are tried.
///   2. At most `limits.steps` steps are taken.
/// @tparam Pair the features, with
///   start(best)           tries cheap axes at time 0; true if one proves the pair free
///   guess(t)              an axis from the (inexact) closest points at t
///   advance(t)            a time up to which, from t on, another certificate holds; t where there is none
///   extrapolate(best, t)  tries an axis that is expected to be the best at a later time
///   consider_all(best, t) tries every candidate axis at t
template <class Pair>
DISMANTLE_HOST_DEVICE AxisCcdResult conservative_advancement(Pair& pair, typename Pair::Axes best,
                                                             const AdvancementLimits& limits = {}) {
  double t = 0;
  if (pair.start(best)) return {{CcdStatus::Free, 1, 0}, best.axis()};
  for (int i = 1; i <= limits.steps; ++i) {
    const AxisGuess guess = pair.guess(t);
    best.consider(guess.axis);
    if (best.end() >= 1) return {{CcdStatus::Free, 1, i}, best.axis()};

    pair.extrapolate(best, t);
    double reached = best.end() > t ? best.end() : t;
    if (i == 1 || reached >= t + limits.min_progress) reached = pair.advance(reached);
    if (reached < t + limits.min_progress && !guess.interior) {
      pair.consider_all(best, t);
      reached = best.end() > reached ? best.end() : reached;
    }
    if (reached >= 1) return {{CcdStatus::Free, 1, i}, best.axis()};
    if (reached < t + limits.min_progress) return {{CcdStatus::Contact, t, i}, best.axis()};
    t = reached;
    best.start(t);
  }
  return {{CcdStatus::Contact, t, limits.steps}, best.axis()};
}

}  // namespace dismantle
