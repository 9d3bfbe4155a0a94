// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/ghost_point.h"

#include "dismantle/audit/solid/piece_tests.h"
#include "dismantle/audit/triangle_axes.h"

#include <algorithm>
#include <cmath>

namespace dismantle::audit {

namespace {

/// Largest number of straight lines of an approach.
constexpr int kMaxLines = 12;

bool allowed(const std::vector<GhostPlane>& planes, Vec3 point, double margin) {
  return std::all_of(planes.begin(), planes.end(),
                     [&](const GhostPlane& p) { return dot(p.normal, point) >= p.offset - margin; });
}

/// The point of the line of two planes that is closest to `target`; the target where they are parallel.
Vec3 on_line(const GhostPlane& p, const GhostPlane& q, Vec3 target) {
  const double c = dot(p.normal, q.normal), det = 1 - c * c;
  if (!(det > 1e-9)) return target;
  const double a = p.offset - dot(p.normal, target), b = q.offset - dot(q.normal, target);
  return target + ((a - c * b) / det) * p.normal + ((b - c * a) / det) * q.normal;
}

/// The point of three planes; `target` where they have none, or more than one.
Vec3 on_corner(const GhostPlane& p, const GhostPlane& q, const GhostPlane& r, Vec3 target) {
  const Vec3 qr = cross(q.normal, r.normal), rp = cross(r.normal, p.normal), pq = cross(p.normal, q.normal);
  const double det = dot(p.normal, qr);
  if (!(std::fabs(det) > 1e-9)) return target;
  return (p.offset * qr + q.offset * rp + r.offset * pq) / det;
}

}  // namespace

Vec3 closest_allowed(const std::vector<GhostPlane>& planes, Vec3 target, Vec3 fallback) {
  constexpr double kMargin = 1e-12;
  const double margin = kMargin * (1 + max_abs(target));
  Vec3 best = fallback;
  const auto consider = [&](Vec3 point) {
    if (length_squared(point - target) < length_squared(best - target) && allowed(planes, point, margin)) best = point;
  };
  consider(target);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    consider(target + (planes[i].offset - dot(planes[i].normal, target)) * planes[i].normal);
    for (std::size_t j = 0; j < i; ++j) {
      consider(on_line(planes[i], planes[j], target));
      for (std::size_t k = 0; k < j; ++k) consider(on_corner(planes[i], planes[j], planes[k], target));
    }
  }
  return best;
}

void GhostPoint::test_face(std::uint32_t face, Vec3 to, Hit& first) const {
  const Triangle t = surface_->triangle(face);
  Vec3 normal = unit_normal(t);
  double from_height = dot(normal, position_ - t[0]), to_height = dot(normal, to - t[0]);
  if (from_height < 0) {
    normal = -normal;
    from_height = -from_height;
    to_height = -to_height;
  }
  if (to_height >= standoff_ / 2 || to_height >= from_height) return;  // half of it absorbs rounding along a face
  const double part = std::max(0.0, (from_height - standoff_) / (from_height - to_height));
  if (part >= first.part) return;
  // Where it is as far from the plane as it may be, and where it would be in the plane.
  const double through = std::min(1.0, from_height / (from_height - to_height));
  for (const double at : {part, through}) {
    const Vec3 point = position_ + at * (to - position_);
    const Vec3 foot = point - dot(normal, point - t[0]) * normal;
    if (length(foot - closest_point(t, foot)) > standoff_) continue;
    first = {part, {normal, dot(normal, t[0]) + standoff_}};
    return;
  }
}

GhostPoint::Hit GhostPoint::first_hit(Vec3 to) const {
  const Vec3 lower = min(position_, to), upper = max(position_, to);
  Hit first;
  std::uint32_t stack[128];
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t i = stack[--depth];
    const BoxNode& node = surface_->node(i);
    const Vec3 apart = max(max(node.center - node.half - upper, lower - node.center - node.half), Vec3{});
    if (max_abs(apart) > 2 * standoff_) continue;
    if (node.leaf()) {
      test_face(node.face, to, first);
    } else {
      stack[depth++] = node.right;
      stack[depth++] = i + 1;
    }
  }
  return first;
}

bool GhostPoint::shift(Vec3 displacement) {
  if (first_hit(position_ + displacement).part <= 1) return false;
  position_ += displacement;
  return true;
}

void GhostPoint::approach(Vec3 target) {
  std::vector<GhostPlane> planes;
  Vec3 goal = target;
  for (int line = 0; line < kMaxLines; ++line) {
    const Hit hit = first_hit(goal);
    if (hit.part > 1) {
      position_ = goal;
      return;
    }
    position_ += hit.part * (goal - position_);
    planes.push_back(hit.plane);
    const Vec3 next = closest_allowed(planes, target, position_);
    if (length(next - position_) < standoff_ / 100) return;
    goal = next;
  }
}

}  // namespace dismantle::audit
