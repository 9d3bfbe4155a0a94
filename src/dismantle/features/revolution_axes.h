// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/geometry/triangle_mesh.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace dismantle {

/// The axis of the cylindrical parts of a surface: bores, shafts, fillets.
struct RevolutionAxis {
  Vec3 point;      ///< The axis' nearest point to the center of the mesh's box [mm].
  Vec3 direction;  ///< Unit, of either sign.
  /// The angle by which the surface turns about the axis, summed over the edges along it [rad]: a bore cut n times
  /// along its length has 2 pi (n + 1).
  double turn = 0;
  /// The smallest distance of these edges [mm]; 0 where it is not known.
  double min_radius = 0;
  /// Their largest distance [mm]; infinite where it is not known.
  double max_radius = std::numeric_limits<double>::infinity();
  friend bool operator==(const RevolutionAxis&, const RevolutionAxis&) = default;
};

/// True if two axes are one, up to these bounds.
/// @param sine of the angle between their directions, of either sign
/// @param distance of the point of `b` from `a` [mm]
inline bool same_axis(const RevolutionAxis& a, const RevolutionAxis& b, double sine, double distance) {
  const Vec3 off = b.point - a.point;
  return length(cross(a.direction, b.direction)) < sine && length(off - dot(off, a.direction) * a.direction) < distance;
}

/// At most so many axes of a mesh are returned.
inline constexpr std::size_t kMaxRevolutionAxes = 32;

/// The axes that a mesh's surface turns about by at least a quarter turn, sorted by descending turn; at most
/// kMaxRevolutionAxes. A heuristic: each edge between two faces of a tessellated cylinder gives the axis of the circle
/// through it and the opposite corners of the faces, and the edges around one cylinder agree. Axes may be missing or
/// meaningless; they only tell where to look.
std::vector<RevolutionAxis> revolution_axes(Span<const Vec3> vertices, Span<const Face> faces);

/// Gives the faces of each cylinder about these axes that goes at least half way around a part number of their own.
/// Faces that have a number keep it. Cylinders beyond part 255 get none.
/// @param parts of each face, 0 for none; empty if no face has one. New numbers follow the largest.
void add_cylinder_parts(Span<const Vec3> vertices, Span<const Face> faces, Span<const RevolutionAxis> axes,
                        std::vector<std::uint8_t>& parts);

}  // namespace dismantle
