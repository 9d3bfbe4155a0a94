// SPDX-License-Identifier: Apache-2.0
#include "dismantle/fasteners/hexagon_drives.h"

#include "dismantle/features/axis_frame.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dismantle {

namespace {

/// A face is parallel to the axis if the cosine between its normal and the axis is below this.
constexpr double kAlong = 0.02;
/// Relative difference up to which distances count as equal.
constexpr double kSameDistance = 2e-3;
/// Maximum angle between the normal of a triangle and that of the hexagon's side that it belongs to [rad].
constexpr double kSameFace = 0.02;
/// Half the width of a hexagon's side as a fraction of its distance from the axis, and relative tolerance of it.
constexpr double kHalfWidth = 0.5773502691896258, kHalfWidthTolerance = 0.02;
/// Minimum fraction of the area at one distance that the six sides cover, and of a sixth of it that each covers.
constexpr double kMinShare = 0.95, kMinSide = 0.6;

const double kSixth = std::acos(-1.0) / 3;

/// A triangle parallel to the axis.
struct FlatFace {
  double distance = 0;    ///< From the axis to its plane; negative if it faces the axis [mm].
  double angle = 0;       ///< Polar angle of its normal [rad].
  double area = 0;        ///< [mm^2]
  double half_width = 0;  ///< Maximum distance of a corner from the foot of the perpendicular, across the axis [mm].
};

std::vector<FlatFace> faces_along(const TriangleMesh& mesh, const AxisFrame& frame) {
  std::vector<FlatFace> faces;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle triangle = mesh.triangle(f);
    const Vec3 scaled = normal_unscaled(triangle);
    const double area = length(scaled) / 2;
    if (!(area > 0) || std::abs(dot(scaled, frame.direction)) > 2 * area * kAlong) continue;
    const Vec3 normal = normalized(scaled), tangent = normalized(cross(frame.direction, normal));
    double half_width = 0;
    for (const Vec3& v : triangle.corner) half_width = std::max(half_width, std::abs(dot(v - frame.point, tangent)));
    faces.push_back(
        {dot(triangle[0] - frame.point, normal), frame.angle(frame.across(frame.point + normal)), area, half_width});
  }
  std::sort(faces.begin(), faces.end(), [](const FlatFace& a, const FlatFace& b) { return a.distance < b.distance; });
  return faces;
}

/// True if faces at one distance form the sides of a hexagon.
bool is_hexagon(Span<const FlatFace> faces) {
  const double first = std::max_element(faces.begin(), faces.end(), [](const FlatFace& a, const FlatFace& b) {
                         return a.area < b.area;
                       })->angle;
  std::array<double, 6> sides{};
  double total = 0, on_sides = 0;
  for (const FlatFace& face : faces) {
    const double turns = (face.angle - first) / kSixth, nearest = std::round(turns);
    total += face.area;
    if (std::abs(turns - nearest) * kSixth > kSameFace) continue;
    if (face.half_width > kHalfWidth * std::abs(face.distance) * (1 + kHalfWidthTolerance)) continue;
    on_sides += face.area;
    sides[static_cast<std::size_t>(nearest + 12) % 6] += face.area;
  }
  const double smallest = *std::min_element(sides.begin(), sides.end());
  return on_sides > kMinShare * total && smallest > kMinSide * total / 6;
}

}  // namespace

std::vector<HexagonDrive> hexagon_drives(const TriangleMesh& mesh, const RevolutionAxis& axis) {
  const std::vector<FlatFace> faces = faces_along(mesh, AxisFrame(axis.point, axis.direction));
  std::vector<HexagonDrive> drives;
  for (auto first = faces.begin(); first != faces.end();) {
    auto last = first;
    while (last != faces.end() && last->distance - first->distance <= kSameDistance * std::abs(first->distance)) ++last;
    const Span<const FlatFace> group(&*first, static_cast<std::size_t>(last - first));
    if (first->distance != 0 && is_hexagon(group))
      drives.push_back(
          {first->distance > 0 ? HexagonDrive::Kind::Head : HexagonDrive::Kind::Socket, 2 * std::abs(first->distance)});
    first = last;
  }
  return drives;
}

}  // namespace dismantle
