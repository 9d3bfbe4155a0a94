// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/surface/moving_surface.h"

#include <optional>

namespace dismantle {

/// A pair of components of S_i during one step.
struct EmbeddedMotion {
  const AssemblyTriangles* streams = nullptr;
  StepTriangles step;
  Span<const Kdop16> bounds;                      ///< Of the whole step.
  ComponentId a, b;                               ///< a < b
  bool a_closed = false, b_closed = false;        ///< Whether "inside" means something.
  Span<const std::uint64_t> triangle_pairs;       ///< Those of S_t that belong to the pair.
  Span<const std::uint64_t> intersecting_at_end;  ///< Those of them that intersect at the end (TID).
  double displacement = 0;    ///< Upper bound of how far the components move against each other in the step [mm].
  double tolerance = 0;       ///< [mm]
  double path_deviation = 0;  ///< How far a vertex's true path may be from the linear one [mm].
};

/// The time of the step from which on the pair must be taken as parted: nullopt where it certainly intersects all the
/// time. docs/formats.md has it that an embedded pair that has once been apart is clear from then on, *at every
/// instant*, so the state at the end of the step does not do. Intersecting throughout an interval is certified by any
/// of
///   1. one triangle pair in which an edge pierces a face: five orientation signs, each a cubic in time whose Bernstein
///      coefficients have one sign beyond what rounding and the deviation of the true paths can change;
///   2. one part inside the other, and no two triangles meeting during the interval;
///   3. at its beginning, a triangle pair deeper than what the components move against each other in it;
///   4. at its beginning, a vertex inside the other component further from its surface than that;
/// 3 and 4 with the deviations on top. So it holds for the true paths as well, but for components inside others that
/// are thinner than twice the deviation (2). Intervals are halved until a certificate holds, down to displacements of
/// kPartingShare of the tolerance; what then is uncertain counts as parted, which may stop a motion, but lets nothing
/// through. At the time returned no triangle pair is deeper than that share of the tolerance plus two deviations: the
/// continuous test that goes on from there starts within its allowance.
std::optional<double> parted_from(const EmbeddedMotion& motion);

/// The share of the tolerance that components may move against each other between two looks.
inline constexpr double kPartingShare = 0.25;

/// Certificate 1 for the whole step by the triangle pairs that intersect at its end: decides most steps of most pairs.
/// Needs no other triangle pairs.
bool pierced_throughout(const EmbeddedMotion& motion);

/// True where the two components share a point at time `s`: surfaces that meet, or one inside the other.
bool components_intersect(const EmbeddedMotion& motion, double s);

}  // namespace dismantle
