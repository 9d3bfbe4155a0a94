// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"

#include <functional>
#include <vector>

namespace dismantle {

/// A half-space of twists: those x with normal . x >= bound. For a contact with gap g, unit normal n and vector r from
/// the point that the twist (v, w) refers to: normal = (n, r x n), bound = -g. Only the ratio of normal to bound
/// matters.
struct HalfSpace {
  double normal[6] = {};  ///< Of any length; the zero normal bounds nothing.
  double bound = 0;       ///< Scaled as the normal; at most 0.
};

/// The result of nearest_twist.
struct NearestTwist {
  double x[6] = {};      ///< The twist.
  int iterations = 0;    ///< Constraints added to or dropped from the active set.
  int active[6] = {};    ///< Indices of the half-spaces whose borders bound x; the first active_count are set.
  int active_count = 0;  ///< 0 to 6
  bool nearest = true;   ///< False if rounding or kNearestTwistIterations ended the search early.
  friend bool operator==(const NearestTwist&, const NearestTwist&) = default;
};

/// Bounds the distance of a result outside a half-space, relative to |normal| |wanted|.
inline constexpr double kNearestTwistSlack = 1e-9;

/// The search ends after that many changes of its active set. Hundreds of facets around a hole need about ten.
inline constexpr int kNearestTwistIterations = 256;

/// The twist in the intersection of half-spaces that is nearest to `wanted`: the quadratic programme of the six-degree
/// god-object (Ortega, Redon, Coquillart 2007). Solved by the dual active-set method of Goldfarb and Idnani (1983) with
/// an identity Hessian, which needs no start point and has at most six active rows.
///   1. The result is in every half-space to kNearestTwistSlack, always.
///   2. It is not further from `wanted` than 0 is, up to rounding.
///   3. If `nearest`, it is the nearest point, up to rounding divided by the sines between active borders.
///   4. Redundant, duplicate, parallel and nearly dependent half-spaces are allowed in any number. A unit
///      normal within a quarter of kNearestTwistSlack of the span of active ones counts as dependent on them.
///   5. It is deterministic.
/// @pre 0 is feasible: every bound is at most 0; all numbers finite
NearestTwist nearest_twist(const double (&wanted)[6], Span<const HalfSpace> half_spaces);

/// Half-spaces that a twist is to be in, too: empty if there are none that it is not in already.
using TwistCuts = std::function<std::vector<HalfSpace>(const NearestTwist& found)>;

/// As nearest_twist(), where the half-spaces of a round constraint are found as they are needed: the search goes on
/// with those that `cut` adds to a result, at most `cuts` times. Their indices follow those of `half_spaces`, in the
/// order in which they are added.
NearestTwist nearest_twist(const double (&wanted)[6], Span<const HalfSpace> half_spaces, int cuts,
                           const TwistCuts& cut);

}  // namespace dismantle
