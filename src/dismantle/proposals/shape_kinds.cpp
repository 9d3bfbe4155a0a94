// SPDX-License-Identifier: Apache-2.0
#include "dismantle/proposals/shape_kinds.h"

#include "dismantle/bvh/obb_fit.h"
#include "dismantle/math/angle.h"
#include "dismantle/math/vec3f.h"
#include "dismantle/narrowphase/closest_points.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace dismantle {

namespace {

/// Vertices are on a torus or a ball within this share of its radius.
constexpr double kRound = 0.03;
/// A ball has at least so many vertices.
constexpr std::size_t kLeastVertices = 20;
/// The middles of its faces are no nearer to its center than this share of the radius: those of an icosahedron are at
/// 0.79.
constexpr double kFacesOfBall = 0.75;
/// Vertices go around a ring in steps no larger than this, but for one [rad].
constexpr double kLargestStep = 0.6;
/// The inner radius of a ring is at least this share of the outer one.
constexpr double kLeastInner = 0.5;
/// The outer vertices of a ring are further out than this share of the farthest.
constexpr double kFarOut = 0.85;
/// The height and the width of a circlip are at most these shares of its outer radius, its gap is between these angles
/// [rad].
constexpr double kMaxClipHeight = 0.3, kMaxClipWidth = 0.4, kMinGap = 0.2, kMaxGap = 2.2;

Obb box_of(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> order(mesh.faces.size());
  std::iota(order.begin(), order.end(), 0u);
  return obb_fit(mesh.vertices, mesh.faces, order, {});
}

/// The two largest steps between neighbours of some angles around a circle, the larger first.
std::pair<double, double> largest_gaps(std::vector<double> angles) {
  std::sort(angles.begin(), angles.end());
  std::vector<double> gaps{angles.front() + kTurn - angles.back()};
  for (std::size_t i = 1; i < angles.size(); ++i) gaps.push_back(angles[i] - angles[i - 1]);
  std::partial_sort(gaps.begin(), gaps.begin() + 2, gaps.end(), std::greater<>());
  return {gaps[0], gaps[1]};
}

/// The center of the circle, across an axis, that fits best to the vertices that are far from another point of the axis
/// (Kasa 1976): that of a ring, whose box is not centred on it if there is a gap.
Vec3 center_of_circle(const TriangleMesh& mesh, Vec3 from, Vec3 first, Vec3 second) {
  double farthest = 0;
  for (const Vec3& p : mesh.vertices)
    farthest = std::max(farthest, std::hypot(dot(p - from, first), dot(p - from, second)));
  Vec3 rows[3], right;
  for (const Vec3& p : mesh.vertices) {
    const double x = dot(p - from, first), y = dot(p - from, second), square = x * x + y * y;
    if (std::sqrt(square) < kFarOut * farthest) continue;
    const Vec3 row{x, y, 1};
    for (int i = 0; i < 3; ++i) rows[i] += row[i] * row;
    right += square * row;
  }
  const double det = dot(rows[0], cross(rows[1], rows[2]));
  if (!(std::abs(det) > 0)) return from;
  // Cramer's rule; the matrix is symmetric.
  const double x = dot(right, cross(rows[1], rows[2])) / det / 2, y = dot(rows[0], cross(right, rows[2])) / det / 2;
  return from + x * first + y * second;
}

/// True if the outer or the inner radius is the same nearly all around: a ring, and no frame.
bool is_round(const std::vector<double>& angles, const std::vector<double>& radii, double inner, double outer) {
  constexpr std::size_t kSectors = 24;
  constexpr double kNear = 0.1, kMost = 0.8;
  double highest[kSectors], lowest[kSectors];
  std::fill(highest, highest + kSectors, 0.0);
  std::fill(lowest, lowest + kSectors, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double share = angles[i] / kTurn + 0.5;
    const std::size_t sector = std::min(kSectors - 1, static_cast<std::size_t>(share * kSectors));
    highest[sector] = std::max(highest[sector], radii[i]);
    lowest[sector] = std::min(lowest[sector], radii[i]);
  }
  std::size_t used = 0, at_outer = 0, at_inner = 0;
  for (std::size_t k = 0; k < kSectors; ++k) {
    if (highest[k] == 0) continue;
    ++used;
    at_outer += highest[k] >= (1 - kNear) * outer;
    at_inner += lowest[k] <= (1 + kNear) * inner;
  }
  return static_cast<double>(std::max(at_outer, at_inner)) >= kMost * static_cast<double>(used);
}

/// How near a triangle comes to an axis.
double distance_from_axis(const Triangle& t, Vec3 center, Vec3 axis) {
  Triangle flat;  // seen along the axis
  for (int i = 0; i < 3; ++i) flat[i] = t[i] - center - dot(t[i] - center, axis) * axis;
  return length(closest_point_of_triangle(flat, {}));
}

}  // namespace

std::optional<RingShape> ring_shape(const TriangleMesh& mesh) {
  if (mesh.faces.empty()) return std::nullopt;
  const Obb box = box_of(mesh);
  // The surface of a ring spreads least along its axis, unless it is as long as wide, which is a tube.
  RingShape ring;
  ring.axis = normalized(to_double(box.third_axis()));
  ring.center = to_double(box.center);
  const Vec3 across = normalized(to_double(box.axis[0])), third = cross(ring.axis, across);
  // The second round is without the vertices of the inner circle that are far from the middle of the box.
  for (int round = 0; round < 2; ++round) ring.center = center_of_circle(mesh, ring.center, across, third);
  ring.inner = std::numeric_limits<double>::infinity();
  double low = ring.inner, high = -low;
  std::vector<double> angles, radii;
  for (const Vec3& p : mesh.vertices) {
    const Vec3 from = p - ring.center;
    const double x = dot(from, across), y = dot(from, third), z = dot(from, ring.axis), radius = std::hypot(x, y);
    ring.inner = std::min(ring.inner, radius);
    ring.outer = std::max(ring.outer, radius);
    low = std::min(low, z);
    high = std::max(high, z);
    angles.push_back(std::atan2(y, x));
    radii.push_back(radius);
  }
  if (!(ring.inner >= kLeastInner * ring.outer) || angles.size() < kLeastVertices) return std::nullopt;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (distance_from_axis(mesh.triangle(f), ring.center, ring.axis) < kLeastInner * ring.outer) return std::nullopt;
  if (!is_round(angles, radii, ring.inner, ring.outer)) return std::nullopt;
  ring.height = high - low;
  const auto [gap, next_gap] = largest_gaps(std::move(angles));
  if (next_gap > kLargestStep) return std::nullopt;
  ring.gap = gap;
  const double section = (ring.outer - ring.inner) / 2, middle = (ring.outer + ring.inner) / 2;
  ring.is_torus = std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [&](Vec3 p) {
    const Vec3 from = p - ring.center;
    const double z = dot(from, ring.axis) - (low + high) / 2;
    const double off = std::hypot(length(from - dot(from, ring.axis) * ring.axis) - middle, z);
    return std::abs(off - section) <= 2 * kRound * section;
  });
  return ring;
}

bool is_circlip(const RingShape& ring) {
  return ring.gap > kMinGap && ring.gap < kMaxGap && ring.outer - ring.inner <= kMaxClipWidth * ring.outer &&
         ring.height < kMaxClipHeight * ring.outer;
}

std::optional<BallShape> ball_shape(const TriangleMesh& mesh) {
  if (mesh.vertices.size() < kLeastVertices) return std::nullopt;
  Aabb box;
  for (const Vec3& p : mesh.vertices) box.extend(p);
  const Vec3 size = box.size();
  const BallShape ball{box.center(), std::max({size.x, size.y, size.z}) / 2};
  const auto on_it = [&](Vec3 p) { return std::abs(length(p - ball.center) - ball.radius) <= kRound * ball.radius; };
  if (!std::all_of(mesh.vertices.begin(), mesh.vertices.end(), on_it)) return std::nullopt;
  // The rims of a cylinder may be on a ball; its faces are not near one.
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle t = mesh.triangle(f);
    if (length((t[0] + t[1] + t[2]) / 3 - ball.center) < kFacesOfBall * ball.radius) return std::nullopt;
  }
  return ball;
}

Vec3 principal_lengths(const TriangleMesh& mesh) {
  if (mesh.faces.empty()) return {};
  const Vec3f half = box_of(mesh).half;
  double lengths[3] = {2.0 * half.x, 2.0 * half.y, 2.0 * half.z};
  std::sort(lengths, lengths + 3);
  return {lengths[0], lengths[1], lengths[2]};
}

double section_of(const TriangleMesh& mesh) {
  double area = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) area += length(normal_unscaled(mesh.triangle(f))) / 2;
  return area > 0 ? 4 * std::abs(signed_volume(mesh)) / area : 0;
}

}  // namespace dismantle
