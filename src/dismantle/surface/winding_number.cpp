// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/winding_number.h"

#include "dismantle/math/angle.h"
#include "dismantle/narrowphase/closest_points.h"
#include "dismantle/surface/boundary_loops.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace dismantle {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kSphere = 2 * kTurn;
/// Far holes are left out of a winding number where all of them together change it by less, unless that decides.
constexpr double kNegligible = 1e-4;

/// The solid angle of a triangle seen from the origin, over that of the sphere; positive seen from behind, where its
/// normal points away (Van Oosterom, Strackee 1983).
double winding_of(Vec3 a, Vec3 b, Vec3 c) {
  const double la = length(a), lb = length(b), lc = length(c);
  const double y = dot(a, cross(b, c));
  const double x = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return 2 * std::atan2(y, x) / kSphere;
}

/// The fan that closes a loop, oriented so that the loop is no boundary of both together.
std::vector<Triangle> fan_of(const std::vector<Vec3>& rim, Vec3 center) {
  std::vector<Triangle> fan;
  for (std::size_t i = 0; i < rim.size(); ++i) fan.push_back({{center, rim[(i + 1) % rim.size()], rim[i]}});
  return fan;
}

double longest_side(const Triangle& t) {
  return std::max({length(t[1] - t[0]), length(t[2] - t[1]), length(t[0] - t[2])});
}

/// The sum of the heights of the fan's triangles over their longest sides.
double width_of(const std::vector<Triangle>& fan) {
  double width = 0;
  for (const Triangle& t : fan) {
    const double side = longest_side(t);
    width += side > 0 ? length(normal_unscaled(t)) / side : 0;
  }
  return width;
}

/// True for a fan in a plane, as near as single precision can tell, whose triangles go once around its center.
bool flat_and_simple(const std::vector<Triangle>& fan, double radius) {
  constexpr double kFlatness = 1e-6;
  Vec3 normal;
  for (const Triangle& t : fan) normal += normal_unscaled(t);
  normal = normalized(normal);
  double turn = 0;
  for (const Triangle& t : fan) {
    const Vec3 from = t[1] - t[0], to = t[2] - t[0];
    if (std::abs(dot(normal, from)) > kFlatness * radius || dot(normal, cross(from, to)) < 0) return false;
    turn += std::atan2(length(cross(from, to)), dot(from, to));
  }
  return std::abs(turn - kTurn) < 1;
}

/// Signed crossings of a ray with a mesh; nothing where rounding hides one.
std::optional<int> signed_crossings(const SurfaceTree& tree, Vec3 point, Vec3 direction) {
  int sum = 0;
  const bool clear = tree.for_each_hit(point, direction, [&](std::uint32_t face, RayHit hit) {
    sum += dot(normal_unscaled(tree.triangle(face)), direction) > 0 ? 1 : -1;
    return hit == RayHit::Hit;
  });
  return clear ? std::optional(sum) : std::nullopt;
}

/// The winding number of two surfaces that make up a closed one; nothing on the surface.
std::optional<int> closed_winding(const SurfaceTree& surface, const SurfaceTree* rest, Vec3 point) {
  for (const Vec3 direction : kRayDirections) {
    const std::optional<int> crossings = signed_crossings(surface, point, direction);
    if (!crossings) continue;
    const std::optional<int> more = rest ? signed_crossings(*rest, point, direction) : 0;
    if (more) return *crossings + *more;
  }
  return std::nullopt;
}

bool outside(const Aabb& box, Vec3 p) {
  return p.x < box.lower.x || p.y < box.lower.y || p.z < box.lower.z || p.x > box.upper.x || p.y > box.upper.y ||
         p.z > box.upper.z;
}

}  // namespace

WindingNumber::WindingNumber(const TriangleMesh& mesh, const SurfaceTree& surface)
    : surface_(surface), diagonal_(diagonal(surface.bounds())) {
  TriangleMesh all_fans;
  std::vector<std::pair<double, Hole>> loops;
  for (const std::vector<std::uint32_t>& loop : boundary_loops(mesh.faces)) {
    Hole hole;
    for (const std::uint32_t v : loop) hole.rim.push_back(mesh.vertices[v]);
    for (const Vec3& p : hole.rim) hole.center += p / static_cast<double>(hole.rim.size());
    const std::vector<Triangle> fan = fan_of(hole.rim, hole.center);
    for (const Triangle& t : fan) {
      const auto first = static_cast<std::uint32_t>(all_fans.vertices.size());
      all_fans.vertices.insert(all_fans.vertices.end(), {t[0], t[1], t[2]});
      all_fans.faces.push_back({{first, first + 1, first + 2}});
      hole.radius = std::max(hole.radius, length(t[1] - hole.center));
      hole.area += length(normal_unscaled(t)) / 2;
      hole.circumference += length(t[2] - t[1]);
    }
    hole.flat = flat_and_simple(fan, hole.radius);
    loops.emplace_back(width_of(fan), std::move(hole));
  }
  if (!all_fans.faces.empty()) fans_ = std::make_unique<const SurfaceTree>(all_fans);

  std::stable_sort(loops.begin(), loops.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  double cracks = 0;
  for (auto& [width, hole] : loops) {
    cracks += width;
    if (cracks <= kCrackWidth * diagonal_) continue;
    rim_edge_count_ += hole.rim.size();
    holes_.push_back(std::move(hole));
  }
}

double WindingNumber::fan_winding(const Hole& hole, Vec3 point) const {
  double sum = 0;
  Vec3 next = hole.rim.front() - point;
  for (std::size_t i = hole.rim.size(); i-- > 0;) {
    const Vec3 at = hole.rim[i] - point;
    sum += winding_of(hole.center - point, next, at);
    next = at;
  }
  return sum;
}

double WindingNumber::at(Vec3 point, double negligible) const {
  if (closed() && outside(surface_.bounds(), point)) return 0;
  std::optional<int> whole = closed_winding(surface_, fans_.get(), point);
  if (!whole) {
    point += kPlacement * diagonal_ * kRayDirections[0];
    whole = closed_winding(surface_, fans_.get(), point);
  }
  if (!whole) return 0;
  double winding = *whole;
  for (const Hole& hole : holes_) {
    const double apart = length(point - hole.center) - hole.radius;
    const double limit = kSphere * negligible / static_cast<double>(holes_.size());
    if (apart > 0 && hole.area < limit * apart * apart) continue;
    winding -= fan_winding(hole, point);
  }
  return winding;
}

bool WindingNumber::inside(Vec3 point) const {
  const double winding = std::abs(at(point, kNegligible));
  if (closed() || std::abs(winding - 0.5) > kNegligible) return winding > 0.5;
  return std::abs(at(point, 0)) > 0.5;
}

std::optional<std::vector<SurfaceCrossing>> WindingNumber::crossings(Vec3 point, Vec3 direction) const {
  std::vector<SurfaceCrossing> crossings;
  for (const SurfaceTree* tree : {&surface_, fans_.get()}) {
    if (!tree) continue;
    const bool clear = tree->for_each_hit(point, direction, [&](std::uint32_t face, RayHit hit) {
      const Triangle& t = tree->triangle(face);
      const Vec3 normal = normal_unscaled(t);
      const double slope = dot(normal, direction);
      crossings.push_back({dot(normal, t[0] - point) / slope, slope > 0 ? 1 : -1});
      return hit == RayHit::Hit;
    });
    if (!clear) return std::nullopt;
  }
  std::sort(crossings.begin(), crossings.end(),
            [](const SurfaceCrossing& a, const SurfaceCrossing& b) { return a.distance < b.distance; });
  return crossings;
}

double WindingNumber::change_at_rim(const Hole& hole, Vec3 center, double radius) const {
  double gradient = 0;
  for (std::size_t i = 0; i < hole.rim.size(); ++i) {
    const Vec3 a = hole.rim[i], b = hole.rim[(i + 1) % hole.rim.size()];
    const double apart = length(center - detail::closest_point_of_segment(a, b, center)) - radius;
    if (apart <= 0) return kInfinite;
    // The integral of the sine of the angle over the squared distance along the edge, by either factor's largest value.
    gradient += std::min(length(b - a) / apart, 2.0) / apart;
  }
  return gradient * radius / kSphere;
}

double WindingNumber::bound_outside_fans(Vec3 center, double radius) const {
  const std::optional<int> whole = closed_winding(surface_, fans_.get(), center);
  if (!whole || *whole != 0) return kInfinite;
  double bound = 0;
  for (const Hole& hole : holes_) {
    const double apart = length(center - hole.center) - hole.radius - radius;
    const double far = apart > 0 ? hole.area / (kSphere * apart * apart) : kInfinite;
    if (!hole.flat && far > 0.5) return kInfinite;
    bound += std::min(far, 0.5);
  }
  return bound;
}

double WindingNumber::max_change(Vec3 center, double radius) const {
  constexpr double kLittle = 0.01;
  double change = 0;
  for (const Hole& hole : holes_) {
    const double apart = length(center - hole.center) - hole.radius - radius;
    const double far = apart > 0 ? hole.circumference * radius / (kSphere * apart * apart) : kInfinite;
    change += far * static_cast<double>(holes_.size()) < kLittle ? far : change_at_rim(hole, center, radius);
  }
  return change;
}

}  // namespace dismantle
