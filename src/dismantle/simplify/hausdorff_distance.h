// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/exec/executor.h"
#include "dismantle/geometry/triangle_mesh.h"

#include <cstddef>

namespace dismantle {

/// Lower and upper bound of a distance between two surfaces [mm].
struct DistanceBounds {
  double lower = 0;  ///< Some point has at least this distance (up to rounding).
  double upper = 0;  ///< No point has a larger distance.
  friend bool operator==(const DistanceBounds&, const DistanceBounds&) = default;
};

/// Accuracy and effort of hausdorff_distance().
struct HausdorffOptions {
  /// The search ends where upper - lower is at most this part of lower, or `absolute_gap` of the diagonal.
  double relative_gap = 0.05;
  double absolute_gap = 1e-5;    ///< As a part of the diagonal of the meshes' box.
  std::size_t pieces = 1 << 12;  ///< Largest number of pieces of a triangle; the bounds may be further apart then.
  Executor executor;             ///< Runs the triangles; the bounds do not depend on it.
};

/// The largest distance of a point of `from` from the surface `to` (the one-sided Hausdorff distance), by branch and
/// bound after Tang, Lee, Kim, "Interactive Hausdorff distance computation for general polygonal models", 2009.
///
/// The upper bound is certain, kHausdorffRounding included. For a convex piece P of a triangle of `from` and *any*
/// triangle t of `to`, the distance to t is a convex function, largest at a corner of P; and the distance to the
/// surface changes by at most the distance moved, so that it is at most that of P's centroid plus P's radius. Pieces
/// whose bound is not close to the lower bound are cut along the sides of the triangle nearest to their centroid, which
/// bounds the part above that triangle tightly.
///
/// The bounds depend on the meshes and options alone. @pre both meshes have a triangle
DistanceBounds one_sided_hausdorff_distance(const TriangleMesh& from, const TriangleMesh& to,
                                            const HausdorffOptions& options = {});

/// The larger of the one-sided distances from `a` to `b` and from `b` to `a`. @pre both meshes have a triangle
DistanceBounds hausdorff_distance(const TriangleMesh& a, const TriangleMesh& b, const HausdorffOptions& options = {});

/// Bound of the rounding of a distance, relative to the largest coordinates of the meshes' box; it is added to the
/// upper bound. A closest point, its distance and the cuts of a piece take under 900 roundings of half a unit each.
inline constexpr double kHausdorffRounding = 1e-13;

}  // namespace dismantle
