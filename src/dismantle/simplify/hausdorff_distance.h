// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/exec/executor.h"
#include "dismantle/geometry/triangle_mesh.h"

#include <cstddef>

namespace dismantle {

/// A distance between two surfaces, from below and from above [mm].
struct DistanceBounds {
  double lower = 0;  ///< Some point is at least this far away (up to rounding).
  double upper = 0;  ///< No point is farther away.
  friend bool operator==(const DistanceBounds&, const DistanceBounds&) = default;
};

/// How hard hausdorff_distance works.
struct HausdorffOptions {
  double relative_gap = 0.05;    ///< Wanted: upper - lower at most this part of lower ...
  double absolute_gap = 1e-5;    ///< ... or this part of the meshes' diagonal, whichever is larger.
  std::size_t pieces = 1 << 12;  ///< Pieces that a triangle is cut into at most; then the upper bound is what it is.
  Executor executor;
};

/// How far a point of `from` can be from the surface `to` (the one-sided Hausdorff distance), by branch and bound.
///
/// The upper bound is certain, up to a rounding of kHausdorffRounding: for a convex piece P of a triangle of `from` and
/// *any* triangle t of `to`, the distance to t is a convex function, so that it is largest at one of P's corners; and
/// the distance to the surface grows no faster than one moves, so that it is at most that of P's centroid plus P's
/// radius. Pieces whose bound is not close to the lower bound are cut along the sides of the triangle nearest to their
/// centroid: the part above it is then bounded tightly. After Tang, Lee, Kim, "Interactive Hausdorff distance
/// computation for general polygonal models", 2009.
///
/// Same input, same bounds, on every executor. @pre both meshes have a triangle
DistanceBounds one_sided_hausdorff_distance(const TriangleMesh& from, const TriangleMesh& to,
                                            const HausdorffOptions& options = {});

/// The larger of the distances from `a` to `b` and from `b` to `a`. @pre both meshes have a triangle
DistanceBounds hausdorff_distance(const TriangleMesh& a, const TriangleMesh& b, const HausdorffOptions& options = {});

/// What rounding may add to a distance, as a part of the largest coordinates of the meshes' box; it is
/// added to the upper bound. A closest point, its distance and the cuts of a piece take under 900 roundings of half a
/// unit each.
inline constexpr double kHausdorffRounding = 1e-13;

}  // namespace dismantle
