// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/surface/moving_surface.h"

#include <optional>

namespace dismantle {

/// A pair of components of S_i during one step.
struct EmbeddedMotion {
  const AssemblyTriangles* streams = nullptr;     ///< The assembled triangles and their hierarchy.
  StepTriangles step;                             ///< At the start and the end of the step.
  Span<const Kdop16> bounds;                      ///< Of the whole step, shape [node_count] [mm, world].
  ComponentId a;                                  ///< The component with the smaller id.
  ComponentId b;                                  ///< The other one.
  bool a_closed = false;                          ///< The surface of `a` is closed.
  bool b_closed = false;                          ///< The surface of `b` is closed.
  Span<const std::uint64_t> triangle_pairs;       ///< Those of S_t that belong to the pair.
  Span<const std::uint64_t> intersecting_at_end;  ///< Those of them that intersect at the end (TID).
  double displacement = 0;    ///< Upper bound of the relative displacement of the components in the step [mm].
  double tolerance = 0;       ///< [mm]
  double path_deviation = 0;  ///< Maximum distance of a vertex's true path from the linear one [mm].
};

/// The time of the step from which on the pair must be treated as parted; nullopt if it certainly intersects
/// throughout. By docs/guarantee.md an embedded pair that has been apart once is clear from then on, *at every
/// instant*, so that the state at the end of the step is not sufficient. Intersection throughout an interval is
/// certified by any of
///   1. one triangle pair in which an edge pierces a face: five orientation signs, each a cubic in time whose Bernstein
///      coefficients have one sign beyond what rounding and the deviation of the true paths can change;
///   2. one part inside the other, and no two triangles meeting during the interval;
///   3. at its beginning, a triangle pair deeper than the relative displacement of the components in it;
///   4. at its beginning, a vertex inside the other component further from its surface than that;
/// 3 and 4 with the deviations added. So the certificates hold for the true paths as well, except for components inside
/// others that are thinner than twice the deviation (2). Intervals are halved until a certificate holds, down to
/// displacements of kPartingShare of the tolerance; a pair that is uncertain then counts as parted, which may stop a
/// motion but misses no contact. At the time returned no triangle pair is deeper than that share of the tolerance plus
/// two deviations: the continuous test over the rest of the step starts within its allowance.
std::optional<double> parted_from(const EmbeddedMotion& motion);

/// Smallest relative displacement of an interval that is tested, as a share of the tolerance.
inline constexpr double kPartingShare = 0.25;

/// True if certificate 1 holds for the whole step, by the triangle pairs that intersect at its end; it decides most
/// steps of most pairs and needs no other triangle pairs.
bool pierced_throughout(const EmbeddedMotion& motion);

/// True if the two components share a point at time `s` of the step: their surfaces meet, or one is inside the other.
bool components_intersect(const EmbeddedMotion& motion, double s);

}  // namespace dismantle
