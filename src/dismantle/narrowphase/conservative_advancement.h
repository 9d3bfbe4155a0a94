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

/// The outward normals of two faces of closed solids and of the faces around them, which decide how an axis w from A to
/// B may use the allowance:
///   1. An axis may use all of it where it leaves A and enters B through their outsides: w agrees with the normal of A
///      or of a face around A, and -w with that of B or of a face around B. Any other axis could call solids separated
///      that overlap behind a face's edge, and would later block every motion.
///   2. An axis against both face normals separates the faces with their solids between them. It needs a gap of kBehind
///      allowances; with less, faces that touch could change sides.
///   3. Any other axis may use nothing.
struct OutwardNormals {
  ///@{ Outward normals of the two faces, of any length.
  Vec3 a, b;
  ///@}
  ///@{ Unit outward normals of the faces at the corners of each.
  Span<const Vec3> around_a, around_b;
  ///@}

  /// Smallest cosine at which an axis agrees with a face's normal: below 0, for faces that turn during the motion or
  /// are seen edge-on.
  static constexpr double kMinCosine = -0.05;
  /// Smallest cosine at which an axis agrees with the normal of a neighbouring face.
  static constexpr double kMinCosineAround = 0.3;
  /// An axis is against a normal where the cosine between them is below minus this.
  static constexpr double kMinCosineAgainst = 0.3;
  /// Gap that an axis against both normals needs, in allowances.
  static constexpr double kBehind = 3;

  /// True if the axis may use the allowance (property 1).
  DISMANTLE_HOST_DEVICE bool allow(Vec3 w) const { return ahead(w, a, around_a) && ahead(-w, b, around_b); }
  /// The depth that is allowed along an axis; negative for a gap that is required.
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

/// The axis tried that separates for the longest time, of those that separate at the current time.
///   1. Up to end() the pair is certainly separated along axis(), by the allowance of that axis.
///   2. Without normals, the axis of the last step (the guard) is only replaced by one within a right angle of it, or
///   by
///      one that separates without the allowance; where the guard itself uses the allowance, by a gap of more than the
///      allowance. Otherwise two faces, which have no thickness, could pass through each other.
///   3. With normals, axes use the allowance as OutwardNormals states.
template <int kCountA, int kCountB>
class FurthestAxis {
 public:
  /// @param hulls must outlive this; @param allowed [mm], >= 0; @param hint the first guard; zero for none
  DISMANTLE_HOST_DEVICE FurthestAxis(const RelativeHulls<kCountA, kCountB>& hulls, double allowed, Vec3 hint)
      : hulls_(hulls), allowed_(allowed), axis_(hint) {
    start(0);
  }

  /// Applies normals to all axes that follow. They define the side, so that no guard is needed.
  DISMANTLE_HOST_DEVICE void face(const OutwardNormals& normals) {
    normals_ = normals;
    facing_ = true;
    guard_ = {};
  }

  /// Begins a step at the time `now`, up to which axis() separates.
  DISMANTLE_HOST_DEVICE void start(double now) {
    now_ = now;
    end_ = -1;
    if (facing_ || !(allowed_ > 0)) return;
    guard_ = axis_;
    guard_checked_ = false;
  }

  /// Tries an axis that points from A to B, of any length.
  DISMANTLE_HOST_DEVICE void consider(Vec3 w) {
    const AxisProjections<kCountA, kCountB> projections(hulls_, w, allowance_of(w));
    if (projections.separates_throughout()) {
      if (!refused(w)) keep(w, 1);
    } else if (!facing_ || normals_.allow(w) || projections.separates_until(now_) > now_ + kMinProgress) {
      keep_if_further(projections, w);
    }
  }

  /// Tries an axis in both directions.
  DISMANTLE_HOST_DEVICE void consider_both_signs(Vec3 w) {
    AxisProjections<kCountA, kCountB> projections(hulls_, w, allowed_);
    keep_if_allowed(projections, w);
    projections.turn();
    keep_if_allowed(projections, -w);
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

  /// @param projections with the allowance: without it they cannot separate further
  DISMANTLE_HOST_DEVICE void keep_if_allowed(const AxisProjections<kCountA, kCountB>& projections, Vec3 w) {
    if (!facing_ || normals_.allow(w)) {
      keep_if_further(projections, w);
    } else if (projections.separates_until(now_) > end_) {
      // Of use only where it makes progress: at a contact the axis has to be one that the normals allow.
      const AxisProjections<kCountA, kCountB> bare(hulls_, w, allowance_of(w));
      if (bare.separates_until(now_) > now_ + kMinProgress) keep_if_further(bare, w);
    }
  }

  DISMANTLE_HOST_DEVICE double allowance_of(Vec3 w) const {
    return facing_ ? normals_.allowance(w, allowed_) : allowed_;
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
  OutwardNormals normals_;
  bool facing_ = false;
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
