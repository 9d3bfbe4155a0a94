// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"

namespace dismantle {

/// The twists x with normal . x >= bound. For a contact with gap g, unit normal n and lever r from the point that the
/// twist (v, w) is given at: normal = (n, r x n), bound = -g. Any scale: only the ratio of normal to bound matters. A
/// zero normal bounds nothing.
struct HalfSpace {
  double normal[6] = {};
  double bound = 0;
};

/// What nearest_twist found.
struct NearestTwist {
  double x[6] = {};
  int iterations = 0;    ///< Constraints taken up or let go.
  int active[6] = {};    ///< Indices of the half-spaces whose borders hold x back; the first active_count count.
  int active_count = 0;  ///< 0 to 6
  bool nearest = true;   ///< False where rounding or kNearestTwistIterations ended the search early.
  friend bool operator==(const NearestTwist&, const NearestTwist&) = default;
};

/// How far a result may be outside a half-space, as a share of |normal| |wanted|.
inline constexpr double kNearestTwistSlack = 1e-9;

/// The search gives up after that many changes of its active set. Hundreds of facets around a hole need about ten.
inline constexpr int kNearestTwistIterations = 256;

/// The six-variable quadratic programme of the god-object (Ortega, Redon, Coquillart 2007): the point of the
/// intersection of half-spaces that is nearest to `wanted`, by the dual active-set method of Goldfarb and Idnani (1983)
/// with an identity Hessian, which needs no start point and at most six active rows.
///   1. The result is in every half-space to kNearestTwistSlack, always.
///   2. It is never further from `wanted` than 0 is, but for rounding.
///   3. With `nearest` it is the nearest point, to rounding divided by the sines between active borders.
///   4. Redundant, duplicate, parallel and nearly dependent half-spaces are allowed in any number. A unit
///      normal within a quarter of kNearestTwistSlack of the span of active ones counts as dependent on them.
///   5. Same input, same result. Nothing is allocated.
/// @pre 0 is feasible: every bound is at most 0; all numbers finite
NearestTwist nearest_twist(const double (&wanted)[6], Span<const HalfSpace> half_spaces);

}  // namespace dismantle
