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

/// As winding_of(), from the origin.
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

Vec3 farthest_from(Vec3 p, const std::vector<Vec3>& points) {
  return *std::max_element(points.begin(), points.end(),
                           [&](Vec3 a, Vec3 b) { return length_squared(a - p) < length_squared(b - p); });
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

double winding_of(const Triangle& triangle, const Vec3& from) {
  return winding_of(triangle[0] - from, triangle[1] - from, triangle[2] - from);
}

WindingNumber::WindingNumber(const TriangleMesh& mesh, const SurfaceTree& surface)
    : surface_(surface), diagonal_(diagonal(surface.bounds())) {
  TriangleMesh all_fans;
  std::vector<Hole> loops;
  for (const std::vector<std::uint32_t>& loop : boundary_loops(mesh)) {
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
    hole.width = width_of(fan);
    hole.spine[0] = farthest_from(hole.center, hole.rim);
    hole.spine[1] = farthest_from(hole.spine[0], hole.rim);
    for (const Vec3& p : hole.rim)
      hole.thickness =
          std::max(hole.thickness, length(p - detail::closest_point_of_segment(hole.spine[0], hole.spine[1], p)));
    loops.push_back(std::move(hole));
  }
  if (!all_fans.faces.empty()) fans_ = std::make_unique<const SurfaceTree>(all_fans);

  std::stable_sort(loops.begin(), loops.end(), [](const Hole& a, const Hole& b) { return a.width < b.width; });
  double cracks = 0;
  for (Hole& hole : loops) {
    cracks += hole.width;
    if (cracks <= kCrackWidth * diagonal_) continue;
    rim_edge_count_ += hole.rim.size();
    holes_.push_back(std::move(hole));
  }
}

/// A bound of the absolute winding number of the fan at the points within `reach` of a point [mm]; infinite near it.
/// A triangle of height h over its longest side, further than D from a point, covers no more of what can be seen from
/// there than a strip of that height: at a place s along the strip, off the foot of the point, it is further than D
/// and than s, so that the integral of h / max(D, s)^2, which is 4 h / D, bounds its solid angle.
double WindingNumber::Hole::bound(Vec3 around, double reach) const {
  double bound = flat ? 0.5 : kInfinite;
  const double off_center = length(around - center) - radius - reach;
  if (off_center > 0) bound = std::min(bound, area / (kSphere * off_center * off_center));
  const double off_spine =
      length(around - detail::closest_point_of_segment(spine[0], spine[1], around)) - thickness - reach;
  if (off_spine > 0) bound = std::min(bound, 4 * width / (kSphere * off_spine));
  return bound;
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
  const std::optional<int> whole = closed_at(point);
  return whole ? at(point, negligible, *whole) : 0;
}

/// The winding number of the mesh closed by its fans; nothing where no ray tells it. @param point is moved a little
/// where it is on a surface
std::optional<int> WindingNumber::closed_at(Vec3& point) const {
  std::optional<int> whole = closed_winding(surface_, fans_.get(), point);
  if (!whole) {
    point += placement() * kRayDirections[0];
    whole = closed_winding(surface_, fans_.get(), point);
  }
  return whole;
}

double WindingNumber::at(Vec3 point, double negligible, int closed) const {
  double winding = closed;
  for (const Hole& hole : holes_) {
    const double apart = length(point - hole.center) - hole.radius;
    const double limit = kSphere * negligible / static_cast<double>(holes_.size());
    if (apart > 0 && hole.area < limit * apart * apart) continue;
    winding -= fan_winding(hole, point);
  }
  return winding;
}

bool WindingNumber::inside(Vec3 point) const {
  if (closed() && outside(surface_.bounds(), point)) return false;
  const std::optional<int> whole = closed_at(point);
  if (!whole) return false;
  double fans = 0;
  for (auto hole = holes_.begin(); hole != holes_.end() && fans < 0.5; ++hole) fans += hole->bound(point, 0);
  if (fans < 0.5) return *whole != 0;
  const double winding = std::abs(at(point, kNegligible, *whole));
  if (std::abs(winding - 0.5) > kNegligible) return winding > 0.5;
  return std::abs(at(point, 0, *whole)) > 0.5;
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
    const double of_hole = hole.bound(center, radius);
    if (of_hole > 0.5) return kInfinite;
    bound += of_hole;
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
