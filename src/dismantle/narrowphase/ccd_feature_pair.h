// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/conservative_advancement.h"
#include "dismantle/narrowphase/coplanarity_advance.h"
#include "dismantle/narrowphase/nonpenetration_filter.h"

namespace dismantle::detail {

/// The common part of a vertex-face and an edge-edge pair for conservative_advancement(): the four points' relative
/// motion and the cubic of their coplanarity.
template <int kCountA, int kCountB>
class FeaturePair {
 public:
  using Axes = FurthestAxis<kCountA, kCountB>;  ///< The axes tried.

  /// Takes the positions as RelativeHulls does. @param cubic must outlive the pair
  DISMANTLE_HOST_DEVICE FeaturePair(const Vec3* a_t0, const Vec3* a_t1, const Vec3* b_t0, const Vec3* b_t1,
                                    const BernsteinCubic& cubic)
      : hulls_(a_t0, a_t1, b_t0, b_t1), cubic_(cubic) {}

  /// The points' relative motion.
  DISMANTLE_HOST_DEVICE const RelativeHulls<kCountA, kCountB>& hulls() const { return hulls_; }
  /// No axis is cheap enough to be tried before the first guess.
  DISMANTLE_HOST_DEVICE bool start(Axes&) const { return false; }
  /// No axis is extrapolated: advance() decides what Newton's method does not.
  DISMANTLE_HOST_DEVICE void extrapolate(Axes&, double) const {}
  /// The time up to which, from `t` on, the four points are certainly never coplanar.
  DISMANTLE_HOST_DEVICE double advance(double t) const { return coplanarity_advance(cubic_, t); }

 protected:
  RelativeHulls<kCountA, kCountB> hulls_;  ///< The points' relative motion.

 private:
  const BernsteinCubic& cubic_;
};

/// The certified test of two features: the non-penetration filter, then conservative advancement.
/// @tparam Pair a FeaturePair with guess() and consider_all()
/// @param hint the axis to try first; zero for none
template <class Pair, class Motion>
DISMANTLE_HOST_DEVICE AxisCcdResult ccd_feature_pair(const Motion& motion, Vec3 hint) {
  const BernsteinCubic cubic = coplanarity_cubic(motion);
  if (certainly_never_coplanar(cubic)) return {{}, hint};
  const Pair pair(motion, cubic);
  return conservative_advancement(pair, typename Pair::Axes(pair.hulls(), 0, hint));
}

}  // namespace dismantle::detail
