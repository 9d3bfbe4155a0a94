// SPDX-License-Identifier: Apache-2.0
#include "dismantle/engine/vertex_motion.h"

#include "dismantle/narrowphase/closest_points.h"

#include <algorithm>
#include <cmath>

namespace dismantle {

namespace {

/// Error of a distance, relative to the coordinates.
constexpr double kDistanceRounding = 1e-13;
/// A sphere is divided if the surface is nearer to its center than this share of its radius, whatever the exact
/// distance.
constexpr double kNearShare = 0.25;
/// Share of the resolution that is kept where one nearby face bounds the depth.
constexpr double kFaceReserveShare = 0.1;
/// Attempts, each a quarter as long as the one before, to find a part of the motion in which one face bounds the depth.
constexpr int kFaceTries = 4;

Pose pose_from_transform(const RigidTransform& t) {
  return {t.translation, quat_from_mat3(t.rotation)};
}

}  // namespace

SurfaceSide SurfaceFreeBalls::side_of(Vec3 point, double clear) const {
  for (const SurfaceFreeBall& ball : last_)
    if (length(point - ball.center) < ball.clear + clear) return ball.side;
  return SurfaceSide::Unknown;
}

VertexMotion::VertexMotion(const WatchedComponent& component, const RigidTransform& start, const RigidTransform& end)
    : component_(component),
      start_(start),
      screw_(screw_between(pose_from_transform(start), pose_from_transform(end))) {}

double VertexMotion::path_length(const VertexSphere& sphere) const {
  return screw_path_length(screw_, screw_radius(screw_, start_ * sphere.center, sphere.radius));
}

SphereOutcome VertexMotion::follow(const WatchedSphere& w, SurfaceFreeBalls& known) const {
  SphereOutcome outcome;
  follow(w, 0, known, outcome);
  return outcome;
}

/// Follows the vertices of a sphere from time `at` of the motion, where `w` is known, to its end.
void VertexMotion::follow(WatchedSphere w, double at, SurfaceFreeBalls& known, SphereOutcome& outcome) const {
  const VertexSphere s = component_.sphere(w.node);
  const Vec3 from = start_ * s.center;
  const double path = path_length(s);
  for (;;) {
    const double left = (1 - at) * path;
    if (allowed_by_face_until(w.face, s, at) >= 1) {
      if (at == 0) outcome.start.push_back(bounded_by_face(w, from, s.radius));
      outcome.end.push_back(bounded_by_face(w.after(left), position(from, 1), s.radius));
      return;
    }
    const Vec3 point = position(from, at);
    evaluate(w, point, s.radius, left, known);
    if (w.side != SurfaceSide::Unknown) known.add({point, w.clear, w.side});
    if (w.slack <= left && !w.node.leaf() && w.slack < std::max(s.radius, component_.resolution)) {
      follow(half(w, s, w.node.left()), at, known, outcome);
      follow(half(w, s, w.node.right()), at, known, outcome);
      return;
    }
    if (at == 0) outcome.start.push_back(w);
    if (w.slack > left) {
      outcome.end.push_back(w.after(left));
      return;
    }
    const double until = allowed_by_face_until(w.face, s, at);
    if (w.slack < component_.resolution && until <= at) {
      if (at < outcome.deep.toi || outcome.deep.face == NearestFace::kNone)
        outcome.deep = {at, component_.tree->order[w.node.begin], w.face};
      return;
    }
    const double next = std::max(until, at + w.slack / path);
    w = w.after((next - at) * path);
    at = next;
  }
}

/// The position at a time of the motion of a point that starts at `from`.
Vec3 VertexMotion::position(Vec3 from, double at) const {
  return at == 0 ? from : transform_from_pose(screw_at(screw_, at)) * from;
}

double VertexMotion::face_distance(std::uint32_t face, Vec3 point) const {
  const ClosestPoints closest = closest_points_vertex_face(point, component_.solid_outer->triangle(face));
  return length(closest.point_b - closest.point_a);
}

/// The time until which one face is near enough to the sphere to bound the depth of all its vertices, on whichever side
/// they are: its distance is convex along a chord, and the arc is near that. At most 1; `at` if the face is no bound.
double VertexMotion::allowed_by_face_until(std::uint32_t face, const VertexSphere& s, double at) const {
  if (face == NearestFace::kNone) return at;
  const Vec3 from = start_ * s.center;
  const double limit = component_.limit - s.radius, first = face_distance(face, position(from, at));
  if (first > limit) return at;
  // A vertex at the limit may still go on if it gets no deeper.
  const double max_distance = std::max(limit - kFaceReserveShare * component_.resolution, first);
  const double bend = screw_chord_deviation(screw_, screw_radius(screw_, from, s.radius));
  double length = 1 - at;
  for (int tries = 0; tries < kFaceTries; ++tries, length /= 4) {
    const double until = tries == 0 ? 1 : at + length;
    if (std::max(first, face_distance(face, position(from, until))) + bend * length * length <= max_distance)
      return until;
  }
  return at;
}

/// Improves the slack by the distance to the known face alone.
WatchedSphere VertexMotion::bounded_by_face(WatchedSphere w, Vec3 center, double radius) const {
  w.slack = std::max(w.slack, component_.limit - radius - face_distance(w.face, center));
  return w;
}

WatchedSphere VertexMotion::half(const WatchedSphere& w, const VertexSphere& s, const VertexNode& node) const {
  WatchedSphere h;
  h.node = node;
  h.face = w.face;
  h.clear = w.clear - length(component_.sphere(node).center - s.center) * (1 + 1e-9);
  h.side = w.side;
  return h;
}

/// Computes the slack of the sphere with its center at `point`, as exactly as the remaining path `left` requires.
void VertexMotion::evaluate(WatchedSphere& w, Vec3 point, double radius, double left,
                            const SurfaceFreeBalls& known) const {
  const SolidTree& outer = *component_.solid_outer;
  const double to_bounds = distance_to_bounds(outer, point);
  if (to_bounds > radius && component_.limit + to_bounds - radius > left) {
    w.side = SurfaceSide::Outside;
    w.clear = to_bounds;
    w.slack = component_.limit + to_bounds - radius;
    return;
  }
  const double accept_below = kNearShare * radius;
  const NearestFace nearest = nearest_face(outer, point, w.face, accept_below);
  const double rounding = kDistanceRounding * (max_abs(point) + nearest.distance);
  const double clear = nearest.distance >= accept_below ? nearest.distance - rounding : 0;
  w.face = nearest.face;
  // The balls around the last center and this one contain no surface: if they overlap, none lies between the centers.
  if (w.clear + clear <= 0) w.side = SurfaceSide::Unknown;
  w.clear = clear;
  // On either side, no vertex is deeper than its distance to the surface.
  w.slack = component_.limit - nearest.distance - radius - rounding;
  if (clear <= radius || (w.side == SurfaceSide::Unknown && w.slack > left)) return;
  if (w.side == SurfaceSide::Unknown) w.side = side_of(point, clear, known);
  if (w.side == SurfaceSide::Outside) w.slack = component_.limit + clear - radius;
}

/// The side of a point whose distance from the surface is at least `clear`.
SurfaceSide VertexMotion::side_of(Vec3 point, double clear, const SurfaceFreeBalls& known) const {
  if (const SurfaceSide side = known.side_of(point, clear); side != SurfaceSide::Unknown) return side;
  return point_in_solid(*component_.solid_outer, point) ? SurfaceSide::Inside : SurfaceSide::Outside;
}

}  // namespace dismantle
