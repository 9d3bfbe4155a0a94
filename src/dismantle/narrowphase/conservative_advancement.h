// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/narrowphase/separating_axis.h"

namespace dismantle {

/// A step that gains less than this part of the motion counts as no progress.
inline constexpr double kMinProgress = 0x1p-26;

/// When a test calls the rest of the motion contact. Whatever they are, it is never too late, only too early.
struct AdvancementLimits {
  int steps = 64;                      ///< After so many steps.
  double min_progress = kMinProgress;  ///< After a step that gains less than this part of the motion.
};

/// How a certified test ended, and the axis that it ended on: the one to try first on the pair's next motion.
struct AxisCcdResult {
  CcdResult ccd;
  /// From a to b, of any length. It separated the pair up to `toi`; zero where nothing did.
  Vec3 axis;
};

/// A direction to try, and whether the closest points that it comes from are in the interiors of both features.
struct AxisGuess {
  Vec3 axis;
  bool interior = false;
};

/// The outward normals of two faces of closed solids, and of the faces around each. An axis from A to B that uses the
/// allowance has to leave A through its outside and enter B through its: one that does not calls things apart that are
/// in each other behind a face's edge, and would be used up later with no way back. At a sharp edge the neighbouring
/// face's outside does as well. An axis against both normals parts the two behind each other's backs, with their solids
/// between them: it counts only where it parts them by kBehind allowances, or faces that touch would be free to change
/// sides.
struct OutwardNormals {
  Vec3 a, b;                            ///< Of any length.
  Span<const Vec3> around_a, around_b;  ///< Unit normals of the faces at the corners.

  /// Least cosine between a normal and the axis: what turns during a motion, and faces seen edge-on, still count.
  static constexpr double kMinCosine = -0.05;
  /// A neighbour has to face the axis by more than that.
  static constexpr double kMinCosineAround = 0.3;

  /// An axis is against a normal where the cosine between them is less than minus this.
  static constexpr double kMinCosineAgainst = 0.3;
  static constexpr double kBehind = 3;

  DISMANTLE_HOST_DEVICE bool allow(Vec3 w) const { return ahead(w, a, around_a) && ahead(-w, b, around_b); }
  /// How deep faces may be in each other along an axis, less than 0 for a gap that is needed.
  DISMANTLE_HOST_DEVICE double allowance(Vec3 w, double allowed) const {
    if (allow(w)) return allowed;
    return against(w, a) && against(-w, b) ? -kBehind * allowed : 0;
  }

 private:
  DISMANTLE_HOST_DEVICE static bool against(Vec3 w, Vec3 normal) {
    const double along = dot(w, normal);
    return along < 0 &&
           along * along > (kMinCosineAgainst * kMinCosineAgainst) * length_squared(w) * length_squared(normal);
  }
  DISMANTLE_HOST_DEVICE static bool ahead(Vec3 w, Vec3 normal, Span<const Vec3> around) {
    const double along = dot(w, normal), square = length_squared(w);
    if (along >= 0 || along * along <= square * (kMinCosine * kMinCosine) * length_squared(normal)) return true;
    for (const Vec3& n : around) {
      const double cosine = dot(w, n);
      if (cosine > 0 && cosine * cosine > square * (kMinCosineAround * kMinCosineAround)) return true;
    }
    return false;
  }
};

/// The axis that separates furthest of those looked at, among those that separate at the present time. An axis may only
/// be left for one within a right angle of it, or one that needs no allowance; where it has itself used part of the
/// allowance by then, for one that separates by more than that: else two flat faces, which have no thickness, could
/// pass through each other, or be taken for having done so.
template <int kCountA, int kCountB>
class FurthestAxis {
 public:
  DISMANTLE_HOST_DEVICE FurthestAxis(const RelativeHulls<kCountA, kCountB>& hulls, double allowed, Vec3 hint)
      : hulls_(hulls), allowed_(allowed), axis_(hint) {
    start(0);
  }

  /// From now on axes that the normals do not allow must separate by what OutwardNormals asks; those that they do allow
  /// may be left for any other, as the normals know the side.
  DISMANTLE_HOST_DEVICE void face(const OutwardNormals& normals) {
    normals_ = normals;
    facing_ = true;
    guard_ = {};
  }

  /// Begins a step at `now`, until which axis() separates.
  DISMANTLE_HOST_DEVICE void start(double now) {
    now_ = now;
    end_ = -1;
    if (facing_ || !(allowed_ > 0)) return;
    guard_ = axis_;
    guard_checked_ = false;
  }

  /// Looks at an axis that points from A to B.
  DISMANTLE_HOST_DEVICE void consider(Vec3 w) {
    const AxisProjections<kCountA, kCountB> projections(hulls_, w, allowance_of(w));
    if (projections.separates_throughout()) {
      if (!refused(w)) keep(w, 1);
    } else if (!facing_ || normals_.allow(w) || projections.separates_until(now_) > now_ + kMinProgress) {
      keep_if_further(projections, w);
    }
  }

  /// Looks at an axis that may point either way.
  DISMANTLE_HOST_DEVICE void consider_both_ways(Vec3 w) {
    AxisProjections<kCountA, kCountB> projections(hulls_, w, allowed_);
    keep_if_allowed(projections, w);
    projections.turn();
    keep_if_allowed(projections, -w);
  }

  DISMANTLE_HOST_DEVICE Vec3 axis() const { return axis_; }
  /// Until when the best axis of this step certainly separates; below `now` where none does.
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

  /// @param projections with the allowance: without it they cannot separate further
  DISMANTLE_HOST_DEVICE void keep_if_allowed(const AxisProjections<kCountA, kCountB>& projections, Vec3 w) {
    if (!facing_ || normals_.allow(w)) {
      keep_if_further(projections, w);
    } else if (projections.separates_until(now_) > end_) {
      // Worth something only where it gets further: at a contact the axis has to be one that the normals allow.
      const AxisProjections<kCountA, kCountB> bare(hulls_, w, allowance_of(w));
      if (bare.separates_until(now_) > now_ + kMinProgress) keep_if_further(bare, w);
    }
  }

  DISMANTLE_HOST_DEVICE double allowance_of(Vec3 w) const {
    return facing_ ? normals_.allowance(w, allowed_) : allowed_;
  }

  /// How the axis that the step began with separates is only asked when it matters.
  DISMANTLE_HOST_DEVICE bool refused(Vec3 w) {
    if (!(dot(w, guard_) < 0)) return false;
    if (!guard_checked_) {
      guard_checked_ = true;
      guard_apart_ = separates_now(guard_, 0);
      // Twice the allowance: where the guard has just been used up to the last bit, rounding must not let it go.
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
  Vec3 guard_;  ///< The axis not to be turned away from; zero for none.
  bool guard_checked_ = false, guard_apart_ = false;
  OutwardNormals normals_;
  bool facing_ = false;
};

/// Conservative advancement (docs/design/0001-certified-ccd.md; after Mirtich 1996, and Catto's time of impact): from
/// the time up to which the motion is certainly allowed, jump to the end of the best certificate, until one lasts to
/// the end (Free) or none gains anything (Contact). Sound whatever axes are tried. `Pair` knows the features:
///   start(best)          tries what is cheap at time 0; true where that proves the pair free
///   guess(t)             an axis from the (inexact) closest points at t
///   advance(t)           a time up to which, from t on, another certificate holds; t where it has none
///   look_ahead(best, t)  tries an axis foreseen for later
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

    pair.look_ahead(best, t);
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
