// SPDX-License-Identifier: Apache-2.0
#include "dismantle/fasteners/axial_sections.h"

#include "dismantle/bvh/obb_fit.h"
#include "dismantle/core/contract.h"
#include "dismantle/features/revolution_axes.h"
#include "dismantle/math/angle.h"
#include "dismantle/math/vec3f.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>

namespace dismantle {

namespace {

/// Planes and rays are off round numbers, so that they meet no vertices.
constexpr double kPlaneOffset = 0.4871, kRayOffset = 0.3819660113;
/// Axes of revolution that are examined.
constexpr std::size_t kMaxAxes = 4;
/// The outline's reach in opposite and sixfold directions differs by no more than this share of it: bosses, lugs and
/// flats make it no fastener; or by this share in all directions: knobs with many sides.
constexpr double kSymmetry = 0.035, kRound = 0.09;
/// Directions of the outline.
constexpr std::size_t kDirections = 36;

double ray_angle(std::size_t k) {
  return (static_cast<double>(k) + kRayOffset) * kTurn / static_cast<double>(kSectionRays);
}

/// The directions of the rays across the axis.
struct RayDirections {
  RayDirections() {
    for (std::size_t k = 0; k < kSectionRays; ++k) {
      x[k] = std::cos(ray_angle(k));
      y[k] = std::sin(ray_angle(k));
    }
  }
  std::array<double, kSectionRays> x, y;
};

/// The point of a segment at a position along the axis.
Vec3 at_plane(Vec3 a, double along_a, Vec3 b, double along_b, double along) {
  return a + ((along - along_a) / (along_b - along_a)) * (b - a);
}

/// Where the rays of a section cross the surface.
struct Crossings {
  std::array<std::uint32_t, kSectionRays> count{};
  std::array<double, kSectionRays> nearest{}, farthest{};  ///< From the axis [mm]; 0 without crossings.
};

/// Adds the crossings of a segment in the plane across the axis.
void add_segment(const AxisFrame& frame, const RayDirections& rays, Vec3 p, Vec3 q, Crossings& crossings) {
  const double px = dot(p - frame.point, frame.first), py = dot(p - frame.point, frame.second);
  const double qx = dot(q - frame.point, frame.first), qy = dot(q - frame.point, frame.second);
  const double step = kTurn / static_cast<double>(kSectionRays);
  double from = std::atan2(py, px), to = std::atan2(qy, qx);
  if (from > to) std::swap(from, to);
  const bool wraps = to - from > kTurn / 2;
  if (wraps) {
    from += kTurn;
    std::swap(from, to);
  }
  const auto first = static_cast<std::int64_t>(std::ceil(from / step - kRayOffset));
  for (std::int64_t k = first; (static_cast<double>(k) + kRayOffset) * step < to; ++k) {
    constexpr auto kCount = static_cast<std::int64_t>(kSectionRays);
    const auto ray = static_cast<std::size_t>(((k % kCount) + kCount) % kCount);
    const double x = rays.x[ray], y = rays.y[ray];
    const double dp = x * py - y * px, dq = x * qy - y * qx;
    if (dp == dq) continue;
    const double t = dp / (dp - dq), radius = x * (px + t * (qx - px)) + y * (py + t * (qy - py));
    if (!(radius > 0)) continue;
    const bool is_first = crossings.count[ray]++ == 0;
    crossings.nearest[ray] = is_first ? radius : std::min(crossings.nearest[ray], radius);
    crossings.farthest[ray] = std::max(crossings.farthest[ray], radius);
  }
}

/// How differently far the vertices reach in different directions across the axis: less than 1 if it may be the axis of
/// a fastener.
double asymmetry(const TriangleMesh& mesh, const AxisFrame& frame) {
  std::array<double, kDirections> reach;
  reach.fill(-std::numeric_limits<double>::infinity());
  std::array<Vec3, kDirections> directions;
  for (std::size_t k = 0; k < kDirections; ++k)
    directions[k] = frame.at(static_cast<double>(k) * kTurn / static_cast<double>(kDirections));
  for (const Vec3& p : mesh.vertices)
    for (std::size_t k = 0; k < kDirections; ++k) reach[k] = std::max(reach[k], dot(p - frame.point, directions[k]));
  const double largest = *std::max_element(reach.begin(), reach.end());
  const double smallest = *std::min_element(reach.begin(), reach.end());
  double sixth = 0;
  for (std::size_t k = 0; k < kDirections; ++k)
    sixth = std::max(sixth, std::abs(reach[k] - reach[(k + kDirections / 6) % kDirections]));
  return std::min(sixth / (kSymmetry * largest), (largest - smallest) / (kRound * largest));
}

}  // namespace

double AxialSection::outer_max() const {
  return *std::max_element(outer.begin(), outer.end());
}

double AxialSection::outer_min() const {
  return *std::min_element(outer.begin(), outer.end());
}

double AxialSection::hole_max() const {
  return *std::max_element(hole.begin(), hole.end());
}

double AxialSection::hole_min() const {
  return *std::min_element(hole.begin(), hole.end());
}

std::size_t AxialSection::misses() const {
  return static_cast<std::size_t>(std::count(hits.begin(), hits.end(), 0));
}

bool AxialSection::axis_is_empty() const {
  const auto even = std::count_if(hits.begin(), hits.end(), [](std::uint8_t n) { return n % 2 == 0; });
  return 2 * static_cast<std::size_t>(even) > kSectionRays;
}

std::vector<AxialSection> axial_sections(const TriangleMesh& mesh, const AxisFrame& frame, std::size_t count) {
  DISMANTLE_EXPECT(count >= 2);
  std::vector<double> along;
  along.reserve(mesh.vertices.size());
  for (const Vec3& p : mesh.vertices) along.push_back(frame.along(p));
  const auto [low, high] = std::minmax_element(along.begin(), along.end());
  const double begin = *low, step = (*high - *low) / static_cast<double>(count);
  std::vector<AxialSection> sections(count);
  std::vector<Crossings> crossings(count);
  const RayDirections rays;
  const auto plane = [&](std::size_t i) { return begin + (static_cast<double>(i) + kPlaneOffset) * step; };
  for (const Face& f : mesh.faces) {
    double z[3];
    for (int k = 0; k < 3; ++k) z[k] = along[f.v[k]];
    const double bottom = std::min({z[0], z[1], z[2]}), top = std::max({z[0], z[1], z[2]});
    const double first = std::max(0.0, std::ceil((bottom - begin) / step - kPlaneOffset));
    for (auto i = static_cast<std::size_t>(first); i < count && plane(i) < top; ++i) {
      const double at = plane(i);
      Vec3 ends[2];
      int found = 0;
      for (int k = 0; k < 3 && found < 2; ++k) {
        const int next = (k + 1) % 3;
        if ((z[k] < at) == (z[next] < at)) continue;
        ends[found++] = at_plane(mesh.vertices[f.v[k]], z[k], mesh.vertices[f.v[next]], z[next], at);
      }
      if (found == 2) add_segment(frame, rays, ends[0], ends[1], crossings[i]);
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    AxialSection& section = sections[i];
    section.along = plane(i);
    for (std::size_t k = 0; k < kSectionRays; ++k) {
      const std::uint32_t hits = crossings[i].count[k];
      section.hits[k] = static_cast<std::uint8_t>(std::min<std::uint32_t>(hits, 255));
      section.outer[k] = crossings[i].farthest[k];
      if (hits % 2 == 0) section.hole[k] = crossings[i].nearest[k];
    }
  }
  return sections;
}

double lobe_amplitude(const std::array<double, kSectionRays>& radii, int order) {
  std::complex<double> sum;
  double mean = 0;
  for (std::size_t k = 0; k < kSectionRays; ++k) {
    sum += std::polar(radii[k], static_cast<double>(order) * ray_angle(k));
    mean += radii[k];
  }
  return mean > 0 ? 2 * std::abs(sum) / mean : 0;
}

std::vector<FastenerAxis> fastener_axes(const TriangleMesh& mesh) {
  if (mesh.faces.empty()) return {};
  Vec3 center;
  double area = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle t = mesh.triangle(f);
    const double own = length(normal_unscaled(t));
    center += (own / 3) * (t[0] + t[1] + t[2]);
    area += own;
  }
  center = center / area;
  std::vector<AxisFrame> frames;
  for (const RevolutionAxis& axis : revolution_axes(mesh.vertices, mesh.faces)) {
    if (frames.size() == kMaxAxes) break;
    const AxisFrame frame(axis.point, axis.direction);
    frames.emplace_back(axis.point + frame.along(center) * axis.direction, axis.direction);
  }
  std::vector<std::uint32_t> order(mesh.faces.size());
  std::iota(order.begin(), order.end(), 0u);
  const Obb box = obb_fit(mesh.vertices, mesh.faces, order, {});
  for (const Vec3f& direction : {box.axis[0], box.axis[1], box.third_axis()})
    frames.emplace_back(center, normalized(to_double(direction)));
  std::vector<std::pair<double, FastenerAxis>> found;
  for (const AxisFrame& frame : frames) {
    const double off = asymmetry(mesh, frame);
    if (!(off < 1)) continue;
    const bool is_known = std::any_of(found.begin(), found.end(), [&](const auto& other) {
      return std::abs(dot(other.second.frame.direction, frame.direction)) > 0.999;
    });
    if (is_known) continue;
    FastenerAxis axis{frame, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), 0};
    for (const Vec3& p : mesh.vertices) {
      axis.begin = std::min(axis.begin, frame.along(p));
      axis.end = std::max(axis.end, frame.along(p));
      axis.radius = std::max(axis.radius, length(frame.across(p)));
    }
    found.emplace_back(off, axis);
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<FastenerAxis> axes;
  axes.reserve(found.size());
  for (const auto& [off, axis] : found) axes.push_back(axis);
  return axes;
}

}  // namespace dismantle
