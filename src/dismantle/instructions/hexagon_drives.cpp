// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/hexagon_drives.h"

#include "dismantle/features/axis_frame.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dismantle {

namespace {

/// Faces are along the axis whose normal's share along it is below.
constexpr double kAlong = 0.02;
/// Distances are equal that differ by no more of themselves.
constexpr double kSameDistance = 2e-3;
/// Normals belong to a face of the hexagon that differ from its own by no more [rad].
constexpr double kSameFace = 0.02;
/// A side of a hexagon reaches this share of its distance aside, and no more than by the second share further.
constexpr double kSideReach = 0.5773502691896258, kSideSlack = 0.02;
/// The six faces have at least this share of all surface at their distance, and each this share of a sixth.
constexpr double kMinShare = 0.95, kMinSide = 0.6;

const double kSixth = std::acos(-1.0) / 3;

/// A triangle along the axis.
struct FlatFace {
  double distance = 0;  ///< Of its plane from the axis, below 0 where it faces it [mm].
  double angle = 0;     ///< Of its normal [rad].
  double area = 0;      ///< [mm^2]
  double aside =
      0;  ///< The furthest that it reaches from the foot of the axis' perpendicular on it, across the axis [mm].
};

std::vector<FlatFace> faces_along(const TriangleMesh& mesh, const AxisFrame& frame) {
  std::vector<FlatFace> faces;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle triangle = mesh.triangle(f);
    const Vec3 scaled = normal_unscaled(triangle);
    const double area = length(scaled) / 2;
    if (!(area > 0) || std::abs(dot(scaled, frame.direction)) > 2 * area * kAlong) continue;
    const Vec3 normal = normalized(scaled), tangent = normalized(cross(frame.direction, normal));
    double aside = 0;
    for (const Vec3& v : triangle.corner) aside = std::max(aside, std::abs(dot(v - frame.point, tangent)));
    faces.push_back(
        {dot(triangle[0] - frame.point, normal), frame.angle(frame.across(frame.point + normal)), area, aside});
  }
  std::sort(faces.begin(), faces.end(), [](const FlatFace& a, const FlatFace& b) { return a.distance < b.distance; });
  return faces;
}

/// Whether faces of one distance are the sides of a hexagon.
bool is_hexagon(Span<const FlatFace> faces) {
  const double first = std::max_element(faces.begin(), faces.end(), [](const FlatFace& a, const FlatFace& b) {
                         return a.area < b.area;
                       })->angle;
  std::array<double, 6> sides{};
  double all = 0, on_sides = 0;
  for (const FlatFace& face : faces) {
    const double turns = (face.angle - first) / kSixth, nearest = std::round(turns);
    all += face.area;
    if (std::abs(turns - nearest) * kSixth > kSameFace) continue;
    if (face.aside > kSideReach * std::abs(face.distance) * (1 + kSideSlack)) continue;
    on_sides += face.area;
    sides[static_cast<std::size_t>(nearest + 12) % 6] += face.area;
  }
  const double least = *std::min_element(sides.begin(), sides.end());
  return on_sides > kMinShare * all && least > kMinSide * all / 6;
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
