// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/surface/solid_shape.h"

#include <cstddef>

namespace dismantle {

/// Accuracy and effort of solid_depth() and solid_contains().
struct DepthOptions {
  double gap = 1e-3;            ///< Largest difference of the bounds [mm], or else `relative_gap` of the lower one.
  double relative_gap = 0.01;   ///< See `gap`.
  std::size_t pieces = 200000;  ///< The search ends after as many pieces of surface; at meshes with holes after fewer.
};

/// Points of meshes with holes whose absolute winding number is nearer to 1/2 than this may count as inside or outside:
/// right above a flat sheet it is 1/2 everywhere.
inline constexpr double kUndecidedWinding = 0.01;

/// Depth of two components.
struct SolidDepth {
  double depth = 0;     ///< An upper bound of the depth [mm], up to rounding; 0 is exact.
  double attained = 0;  ///< The depth at `deepest_at`: a lower bound [mm].
  Vec3 deepest_at;      ///< A point of one surface inside the other [mm, world frame]; the origin if `attained` is 0.
  bool of_b = false;    ///< `deepest_at` lies on the surface of `b`, inside `a`; else on that of `a`.
  /// The search ended after DepthOptions::pieces, and the bounds may be further apart than asked for.
  bool capped = false;
  std::size_t pieces = 0;  ///< What it cost: pieces of surface, and as many more as winding numbers of holes cost.
};

/// The depth of two components at two poses: the greatest distance from a point of either surface that is inside the
/// other component to that component's surface; 0 where they do not overlap. Inside is where the absolute winding
/// number is above 1/2 (WindingNumber), so that cracked, open and inside-out meshes have a depth.
///
/// Best-first branch and bound over both surfaces, of which nodes of the tree and then convex pieces of triangles are
/// divided. A piece has no point deeper than the distance of its farthest corner from any one triangle of the other
/// surface, which is a convex function, nor than the depth of its centroid plus its radius, as depth is 1-Lipschitz. A
/// piece whose ball does not meet the other surface is outside as a whole if the winding number cannot reach 1/2 in it.
/// The result depends on the components, poses and options alone.
SolidDepth solid_depth(const PlacedShape& a, const PlacedShape& b, const DepthOptions& options = {});

/// True if `inner` lies wholly within `outer`: no point of its surface is further outside `outer` than `tolerance`
/// [mm], and no point of the surface of `outer` deeper inside `inner`, to within DepthOptions::gap. False also where
/// the search ended early.
bool solid_contains(const PlacedShape& outer, const PlacedShape& inner, double tolerance,
                    const DepthOptions& options = {});

}  // namespace dismantle
