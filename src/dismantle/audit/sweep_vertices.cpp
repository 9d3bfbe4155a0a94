// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/sweep_vertices.h"

#include <algorithm>

namespace dismantle::audit {

namespace {

/// The depth above which a breach is reported: the limit plus rounding.
double breach_depth(const VertexSweep& sweep) {
  return sweep.limit * (1 + 1e-9) + sweep.rounding;
}

/// Follows one vertex segment by segment.
class VertexWalk {
 public:
  VertexWalk(const VertexSweep& sweep, std::uint32_t vertex) : sweep_(sweep), point_(sweep.points->vertex(vertex)) {}

  /// Follows the vertex through a segment. @param crossing the time at which it may cross the surface; null for never
  /// @param tracked true if it may be inside at the start
  /// @return true if it may be inside at the end
  bool advance(std::uint32_t segment, const CrossingVertex* crossing, bool tracked) {
    const RelativeMotion& motion = sweep_.motions[segment];
    const double speed = length(motion.velocity(motion.start * point_));
    const double from = crossing != nullptr ? crossing->from : 0, to = crossing != nullptr ? crossing->to : 0;
    outside_distance_ = tracked ? -1 : 0;
    if (tracked && (crossing == nullptr || from > 0) && is_outside(motion.start * point_, 0)) tracked = false;
    if (!tracked && crossing == nullptr) return false;
    bool crosses = crossing != nullptr;  // it may from here on
    double s = tracked ? 0 : from, moved = 0;
    if (s > 0) outside_distance_ = 0;
    while (s < 1) {
      const Vec3 x = motion.at(s) * point_;
      if (crosses && s >= to) {
        if (is_outside(x, moved)) return false;
        crosses = false;
      }
      double step = time_near_surface(motion, x, s);
      if (step < 1 - s) {
        const SurfacePoint near = closest(x);
        step = time_near_surface(motion, x, s);
        if (near.distance > breach_depth(sweep_)) {
          if (!is_outside(x, near.distance, moved)) {
            findings.breach.add(segment, s, near.distance);
            return true;
          }
          if (!crosses || near.distance > speed * (to - s)) return false;
          moved = 0;
          step = (near.distance + sweep_.limit) / speed;
        }
      }
      if (speed > 0) step = std::max(step, sweep_.resolution / speed);
      if (crosses && s + step > to) step = to - s;
      s += step;
      moved += step * speed;
    }
    return !(crosses && is_outside(motion.at(1) * point_, moved));
  }

  VertexFindings findings;

 private:
  static constexpr int kHalvings = 20;

  SurfacePoint closest(Vec3 x) {
    ++findings.samples;
    const SurfacePoint near = sweep_.solid->closest(x, face_);
    face_ = near.face;
    return near;
  }

  /// True if the vertex is off the surface at `x`, and outside. @param moved its path length since it was last outside
  bool is_outside(Vec3 x, double moved) {
    const double distance = closest(x).distance;
    return distance > sweep_.rounding && is_outside(x, distance, moved);
  }
  /// The same for a known distance from the surface, above the rounding. The vertex is still outside if the empty balls
  /// around its last outside position and around `x` cover the path between; else a ray decides.
  bool is_outside(Vec3 x, double distance, double moved) {
    const bool still = outside_distance_ >= 0 && moved < outside_distance_ + distance - sweep_.rounding;
    if (!still && sweep_.solid->contains(x)) return false;
    outside_distance_ = distance;
    return true;
  }

  /// The time for which the vertex, at `x` at time s, certainly remains within the limit of the triangle that was last
  /// closest to it, and so no deeper; 0 where it is not within the limit now. The distance from a triangle is convex
  /// along a chord, and the path deviates from its chord by at most acceleration * time^2 / 8.
  double time_near_surface(const RelativeMotion& motion, Vec3 x, double s) const {
    const Triangle triangle = sweep_.solid->triangle(face_);
    const double now = distance_to_triangle(triangle, x);
    if (now > breach_depth(sweep_)) return 0;
    const double acceleration = motion.acceleration(motion.velocity(x));
    double time = 1 - s;
    for (int k = 0; k < kHalvings; ++k, time /= 2) {
      const double then = distance_to_triangle(triangle, motion.at(s + time) * point_);
      const double deviation = acceleration * time * time / 8;
      if (std::max(now, then) + deviation <= sweep_.limit + sweep_.resolution / 2) return time;
    }
    return 0;
  }

  const VertexSweep& sweep_;
  const Vec3 point_;
  std::uint32_t face_ = 0;
  double outside_distance_ = -1;  // from the surface at its last outside position; negative: there is none
};

}  // namespace

VertexFindings sweep_vertex(const VertexSweep& sweep, std::uint32_t vertex, bool tracked,
                            Span<const CrossingVertex> crossings) {
  VertexWalk walk(sweep, vertex);
  const CrossingVertex* next = crossings.begin();
  for (std::uint32_t k = sweep.first_active; k < sweep.end; ++k) {
    while (next != crossings.end() && next->segment < k) ++next;
    if (!tracked) {
      if (next == crossings.end()) break;
      k = next->segment;
      if (k >= sweep.end) break;
    }
    const bool may_cross = next != crossings.end() && next->segment == k;
    tracked = walk.advance(k, may_cross ? next : nullptr, tracked);
    if (walk.findings.breach.depth > 0) break;
  }
  walk.findings.tracked = tracked;
  return walk.findings;
}

InsideVertices find_inside_vertices(const VertexSweep& sweep, std::uint32_t segment) {
  InsideVertices found;
  if (sweep.solid->empty()) return found;
  const RigidTransform& solid_from_points = sweep.motions[segment].start;
  std::uint32_t face = 0;
  for (std::uint32_t v = 0; v < sweep.points->vertex_count(); ++v) {
    const Vec3 x = solid_from_points * sweep.points->vertex(v);
    if (!sweep.solid->contains(x)) continue;
    ++found.samples;
    const SurfacePoint near = sweep.solid->closest(x, face);
    face = near.face;
    found.vertices.push_back(v);
    if (near.distance > breach_depth(sweep)) found.breach.add(segment, 0, near.distance);
  }
  return found;
}

}  // namespace dismantle::audit
