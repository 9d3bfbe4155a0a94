// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/ghosts/overlap_retraction.h"
#include "dismantle/features/revolution_axes.h"
#include "dismantle/surface/ghost_surface.h"

#include <functional>
#include <optional>
#include <vector>

namespace dismantle {

/// The axes of cylinders and threads that two components share, at most three of them.
/// @param within axes that are no further apart than this are one [mm]
std::vector<RevolutionAxis> common_axes(const SolidTree& a, const SolidTree& b, double within);

/// Two components about a common axis: a screw in its nut, ridges in grooves.
struct CoaxialRequest {
  const OverlapSide* own = nullptr;    ///< The component whose ghost surface is wanted; never null.
  const OverlapSide* other = nullptr;  ///< The other one; never null.
  /// The surface of `own`; never null.
  const RetractableSurface* surface = nullptr;
  RevolutionAxis axis;      ///< One of common_axes().
  std::vector<Vec3> start;  ///< Displaced vertices to start from [mm].
  double max_length = 0;    ///< Largest displacement of a vertex [mm].
  double depth_limit = 0;   ///< No vertex gets deeper in its solid than that [mm].
  /// Distances from the other component that are tried, the larger ones first [mm].
  std::vector<double> gaps;
  /// Past all of the other component, however far it is along the axis, and not only past what is beside this one.
  bool whole = true;
  /// For each vertex, if it may be moved; empty: all may.
  std::vector<bool> movable = {};
};

/// The part of a common axis along which two components overlap much deeper than elsewhere: the run-out of a thread.
struct DeepRange {
  double begin = 0;      ///< Position along the axis, as AxisFrame has it [mm].
  double end = 0;        ///< The same of its other end [mm].
  double elsewhere = 0;  ///< No vertex outside the range is deeper [mm].

  /// True if a position along the axis is in the range, or no further than `beyond` from it [mm].
  bool contains(double along, double beyond) const { return along >= begin - beyond && along <= end + beyond; }
};

/// Short ranges of vertices of either component that are much deeper in the other one than most are; the one with the
/// least depth elsewhere first. None where vertices are about equally deep all along the axis.
/// @param least depths below this one do not count [mm] @param depth of the pair [mm]
std::vector<DeepRange> deep_ranges(const OverlapSide& a, const OverlapSide& b, const RevolutionAxis& axis, double least,
                                   double depth);

/// Displaced vertices in which what engages is gone: vertices of an outer surface that reach beyond the other
/// component's bore are moved straight towards the axis, and those of a bore that the other component reaches into
/// straight away from it. Two components of any profile, such as a nut that is drawn half a pitch off its screw, can
/// then slide past each other along the axis. Vertices that would have to go too far, or would get too deep, are not
/// moved, nor are those beside cracks.
/// @param good whether vertices are apart from the other component, and no point between them gets too deep on its way
/// @return the first that are; nothing if none are
std::optional<std::vector<Vec3>> coaxial_ghost(const CoaxialRequest& request,
                                               const std::function<bool(const std::vector<Vec3>&)>& good);

}  // namespace dismantle
