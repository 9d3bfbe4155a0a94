// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/surface_crossing.h"

#include "dismantle/audit/solid/ghost_point.h"

#include <algorithm>
#include <cmath>

namespace dismantle::audit {

namespace {

/// Distance that ghosts keep from the surface, relative to the slack.
constexpr double kStandoff = 0.1;
/// A point is followed in steps of this part of the allowed distance where its ghost is held back.
constexpr double kStep = 0.25;
/// The lengths of offsets that are tried for ghosts, as parts of the allowed distance, and the number of directions.
constexpr double kOffsets[] = {1, 0.7, 0.4};
constexpr int kDirections = 128;
/// A mesh is thin where its mean thickness is less than this many times the tolerance.
constexpr double kThin = 4;

/// One point in one move.
class PointFollower {
 public:
  PointFollower(const AuditBody& surface, const CrossingRule& rule, FollowedPoint& point)
      : surface_(surface), rule_(rule), ghost_(point.ghost), has_been_clear_(point.has_been_clear) {}

  /// Follows the point through a segment. @return where it went through the surface
  Crossing follow(Vec3 body, std::uint32_t segment) {
    const RelativeMotion& motion = rule_.motions[segment];
    const double allowed = rule_.allowed[segment];
    const Hole* const hole = segment < rule_.hole_until ? rule_.hole : nullptr;
    Vec3 now = motion.at(0) * body;
    const double speed = length(motion.velocity(now));
    const double bend = motion.screw.angle > 0 ? motion.acceleration(motion.velocity(now)) / 8 : 0;
    const double longest = bend > 0 ? std::sqrt(rule_.slack / (4 * bend)) : 1;
    for (double s = 0; s < 1;) {
      const double step = std::min({longest, 1 - s, begin_step(now, {segment, s}, allowed, speed)});
      const double shortest = speed > 0 ? kStep * allowed / speed : 1;
      s = advance(motion, body, {s, step, shortest, allowed, hole}, now);
      const double beyond = ghost_ ? length(now - *ghost_) : 0;
      if (beyond > allowed + rule_.slack && !find_offset(body, {segment, s})) return {beyond, segment, s, now};
      if (speed == 0) break;
    }
    return {};
  }

 private:
  struct Time {
    std::uint32_t segment = 0;
    double s = 0;
  };
  struct Step {
    double from, length, shortest, allowed;
    const Hole* hole;  // null for none
  };

  /// Starts or ends the ghost at a point. @return a time in which the point needs none
  double begin_step(Vec3 now, Time time, double allowed, double speed) {
    double distance = surface_.distance_from_box(now);
    if (distance <= 2 * allowed) {
      const SurfacePoint closest = surface_.closest(now, last_face_);
      last_face_ = closest.face;
      distance = closest.distance;
    }
    if (distance > allowed + rule_.slack) {
      ghost_.reset();
      has_been_clear_ = true;
      return speed > 0 ? std::max(distance - allowed, kStep * allowed) / speed : 1;
    }
    if (!ghost_ && has_been_clear_) {
      ghost_ = now;
      begun_ = time;
      has_begun_ = true;
    }
    return ghost_ || speed == 0 ? 1 : kStep * allowed / speed;
  }

  /// Moves the point and its ghost on by a step, or by less where the ghost is held back. @return the time
  double advance(const RelativeMotion& motion, Vec3 body, Step step, Vec3& now) {
    Vec3 next = motion.at(step.from + step.length) * body;
    if (!ghost_) {
      now = next;
      return step.from + step.length;
    }
    GhostPoint ghost(surface_, kStandoff * rule_.slack, *ghost_);
    // Beside the point on its chord, the ghost is never further from it than at the ends.
    while (!ghost.shift(next - now) && step.length > step.shortest) {
      step.length /= 2;
      next = motion.at(step.from + step.length) * body;
    }
    ghost.approach(next);
    ghost_ = ghost.position();
    now = next;
    if (step.hole && length(now - *ghost_) > step.allowed / 2 && is_in(*step.hole, now)) {
      ghost_.reset();
      has_been_clear_ = false;
    }
    return step.from + step.length;
  }

  /// True if the point or its ghost is in a hole, so that both sides are free.
  bool is_in(const Hole& hole, Vec3 now) const { return hole.has(now) || hole.has(*ghost_); }

  /// Looks for another ghost, one that keeps its offset from the point in the point's body since the first ghost began
  /// in this move; the one that comes as near as it can may be held back behind a corner.
  bool find_offset(Vec3 body, Time until) {
    if (!has_begun_) return false;
    for (std::uint32_t k = begun_.segment; k < until.segment; ++k)
      if (rule_.allowed[k] != rule_.allowed[until.segment]) return false;
    const double allowed = rule_.allowed[until.segment];
    for (const double share : kOffsets)
      for (int i = 0; i < kDirections; ++i) {
        const Vec3 offset = share * allowed * direction(i);
        if (!stays_clear(body, offset, until)) continue;
        ghost_ = rule_.motions[until.segment].at(until.s) * (body + offset);
        return true;
      }
    return false;
  }

  /// True if a point at an offset can be reached from the point where the ghost began, and does not meet the surface
  /// until a time.
  bool stays_clear(Vec3 body, Vec3 offset, Time until) const {
    const double standoff = kStandoff * rule_.slack;
    const RelativeMotion& first = rule_.motions[begun_.segment];
    GhostPoint ghost(surface_, standoff, first.at(begun_.s) * body);
    if (!ghost.shift(first.at(begun_.s) * (body + offset) - ghost.position())) return false;
    for (std::uint32_t k = begun_.segment; k <= until.segment; ++k) {
      const RelativeMotion& motion = rule_.motions[k];
      const double from = k == begun_.segment ? begun_.s : 0, to = k == until.segment ? until.s : 1;
      const double bend = motion.screw.angle > 0 ? motion.acceleration(motion.velocity(ghost.position())) / 8 : 0;
      const double chords = std::ceil((to - from) * std::sqrt(4 * bend / rule_.slack)) + 1;
      for (double i = 1; i <= chords; ++i)
        if (!ghost.shift(motion.at(from + i / chords * (to - from)) * (body + offset) - ghost.position())) return false;
    }
    return true;
  }

  /// Directions spread over the sphere, by the golden angle.
  static Vec3 direction(int i) {
    constexpr double kGoldenAngle = 2.399963229728653;
    const double z = 1 - (2 * i + 1.0) / kDirections, r = std::sqrt(1 - z * z);
    return {r * std::cos(kGoldenAngle * i), r * std::sin(kGoldenAngle * i), z};
  }

  const AuditBody& surface_;
  const CrossingRule& rule_;
  Time begun_;              // when the ghost did, in this move
  bool has_begun_ = false;  // it did so in this move
  std::optional<Vec3>& ghost_;
  bool& has_been_clear_;
  std::uint32_t last_face_ = 0;
};

std::size_t divisions(const Triangle& t, double spacing) {
  double longest = 0;
  for (int k = 0; k < 3; ++k) longest = std::max(longest, length(t[(k + 1) % 3] - t[k]));
  return static_cast<std::size_t>(std::ceil(std::min(longest / spacing, 1e6)));
}

double mean_thickness(const AuditBody& body) {
  double area = 0, volume = 0;
  for (std::uint32_t f = 0; f < body.face_count(); ++f) {
    const Triangle t = body.triangle(f);
    const Vec3 normal = normal_unscaled(t) / 2.0;
    area += length(normal);
    volume += dot(normal, t[0]) / 3;
  }
  return area > 0 ? 2 * std::fabs(volume) / area : 0;
}

}  // namespace

void visit_points_of_faces(const AuditBody& body, double spacing,
                           const std::function<void(std::uint32_t, Vec3)>& visit) {
  for (spacing = std::max(spacing, 1e-9 * body.node(0).reach);; spacing *= 1.5) {
    std::size_t count = body.vertex_count();
    for (std::uint32_t f = 0; f < body.face_count(); ++f) {
      const std::size_t n = divisions(body.triangle(f), spacing);
      count += n * (n + 3) / 2 - 2;
    }
    if (count <= std::max(kMaxFollowed, body.vertex_count())) break;
  }
  for (std::uint32_t f = 0; f < body.face_count(); ++f) {
    const Triangle t = body.triangle(f);
    const std::size_t n = divisions(t, spacing);
    for (std::size_t i = 0; i <= n; ++i)
      for (std::size_t j = 0; i + j <= n; ++j) {
        if (i == n || j == n || (i == 0 && j == 0)) continue;
        const double u = double(i) / double(n), v = double(j) / double(n);
        visit(f, t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]));
      }
  }
}

std::vector<FollowedPoint> followed_points(const AuditBody& body, double spacing) {
  std::vector<FollowedPoint> followed;
  for (std::uint32_t v = 0; v < body.vertex_count(); ++v) followed.push_back({body.vertex(v), {}, false});
  visit_points_of_faces(body, spacing, [&](std::uint32_t, Vec3 point) { followed.push_back({point, {}, false}); });
  return followed;
}

bool Hole::has(Vec3 point) const {
  const Vec3 there = point + (solid_->surface().center() - other_->surface().center());
  if (other_->surface().distance_from_box(there) > margin_) return false;
  if (!other_->surface().face_within(there, margin_) && !other_->inside(there)) return false;
  return known_->has_hole(*solid_, *other_, finest_);
}

Crossing follow_points(const AuditBody& surface, std::vector<FollowedPoint>& followed, const CrossingRule& rule) {
  Crossing first;
  for (FollowedPoint& point : followed) {
    PointFollower follower(surface, rule, point);
    for (std::uint32_t k = 0; k < rule.motions.size(); ++k) {
      const Crossing crossing = follower.follow(point.body, k);
      if (crossing.beyond == 0) continue;
      const bool earlier = first.beyond == 0 || crossing.segment < first.segment ||
                           (crossing.segment == first.segment && crossing.s < first.s);
      if (earlier) first = crossing;
      break;
    }
  }
  return first;
}

bool needs_crossing_test(const SolidBody& a, const SolidBody& b, double tolerance) {
  for (const SolidBody* body : {&a, &b})
    if (!body->surface().empty() && (!body->solid() || mean_thickness(body->surface()) < kThin * tolerance))
      return true;
  return false;
}

}  // namespace dismantle::audit
