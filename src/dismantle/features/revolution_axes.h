// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/geometry/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// The axis of a bore, a shaft or whatever else of a surface is cylindrical.
struct RevolutionAxis {
  Vec3 point;      ///< On it, where it is nearest to the middle of the mesh's box [mm].
  Vec3 direction;  ///< Unit, of either sign.
  /// By how much the surface turns about it, summed over the edges along it [rad]: a bore cut n times along its length
  /// has 2 pi (n + 1).
  double turn = 0;
  friend bool operator==(const RevolutionAxis&, const RevolutionAxis&) = default;
};

/// The axes that a mesh's surface turns about by at least a quarter of a turn, those of the largest turn first; at most
/// kMaxRoundAxes. Found by the edges that run along cylinders, as tessellations of CAD models have them: each gives
/// the axis of the circle through it and the opposite corners of its two faces, and around a cylinder all agree. An
/// axis may be missing, or mean nothing; what is given is only where to look.
std::vector<RevolutionAxis> revolution_axes(Span<const Vec3> vertices, Span<const Face> faces);

inline constexpr std::size_t kMaxRoundAxes = 32;

/// Numbers the cylinders about these axes that go at least half way around: the faces of each that have no number yet
/// get one of their own, next to those that there are, as far as numbers reach.
/// @param parts of each face, 0 for none; empty for none of all
void add_cylinder_parts(Span<const Vec3> vertices, Span<const Face> faces, Span<const RevolutionAxis> axes,
                        std::vector<std::uint8_t>& parts);

}  // namespace dismantle
