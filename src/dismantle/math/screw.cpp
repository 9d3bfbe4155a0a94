// SPDX-License-Identifier: Apache-2.0
#include "dismantle/math/screw.h"

#include <cmath>

namespace dismantle {

namespace {

Vec3 along_axis(const Screw& screw, Vec3 v) {
  return dot(v, screw.axis) * screw.axis;
}

/// The pose at time `s` of a body that starts at `start`.
Pose moved_by(const Screw& screw, double s, const Pose& start) {
  const Pose moved = screw_at(screw, s);
  // The reference is the image of the assembly's origin, so its path is the position itself.
  const Vec3 position = moved.position + mat3_from_quat(moved.rotation) * start.position;
  return {position, normalized(moved.rotation * start.rotation)};
}

}  // namespace

Screw screw_between(const Pose& start, const Pose& end) {
  Quat q = end.rotation * conjugate(start.rotation);
  if (q.w < 0) q = -q;
  const Vec3 imaginary{q.x, q.y, q.z};
  const double sine = length(imaginary);

  Screw screw;
  screw.reference = start.position;
  const Vec3 shift = end.position - start.position;
  const double angle = 2 * std::atan2(sine, q.w);
  if (angle < kScrewMinimumAngle) {
    screw.velocity = shift;
    return screw;
  }
  screw.axis = imaginary / sine;
  screw.angle = angle;
  // Inverts shift_across = sin(a)/a v + (1 - cos(a))/a axis x v; (a/2) cot(a/2) tends to 1 for small angles.
  const Vec3 across = shift - along_axis(screw, shift);
  screw.velocity = (angle / 2) * ((q.w / sine) * across - cross(screw.axis, across)) + along_axis(screw, shift);
  return screw;
}

Pose screw_at(const Screw& screw, double s) {
  if (screw.angle == 0) return {s * screw.velocity, Quat{}};
  const Vec3 along = along_axis(screw, screw.velocity);
  const Vec3 across = screw.velocity - along;
  const double half = s * screw.angle / 2;
  const double half_sine = std::sin(half);
  const double sine_over_angle = 2 * half_sine * std::cos(half) / screw.angle;
  const double versine_over_angle = 2 * half_sine * half_sine / screw.angle;
  const Vec3 shift = sine_over_angle * across + versine_over_angle * cross(screw.axis, across) + s * along;
  const Quat rotation = quat_about(screw.axis, s * screw.angle);
  return {screw.reference + shift - mat3_from_quat(rotation) * screw.reference, rotation};
}

Pose pose_between(const Pose& start, const Pose& end, double s) {
  if (s <= 0) return start;
  if (s >= 1) return end;
  return moved_by(screw_between(start, end), s, start);
}

Vec3 screw_axis_point(const Screw& screw) {
  return screw.reference + cross(screw.axis, screw.velocity) / screw.angle;
}

double screw_radius(const Screw& screw, Vec3 center, double radius) {
  if (screw.angle == 0) return 0;
  const Vec3 offset = center - screw_axis_point(screw);
  return length(offset - along_axis(screw, offset)) + radius;
}

double screw_path_length(const Screw& screw, double rho) {
  if (screw.angle == 0) return length(screw.velocity);
  const double arc = screw.angle * rho;
  const double pitch = dot(screw.velocity, screw.axis);
  return std::sqrt(arc * arc + pitch * pitch);
}

double screw_chord_deviation(const Screw& screw, double rho) {
  return rho * screw.angle * screw.angle / 8;
}

Pose ScrewMotion::at(double s) const {
  if (s <= 0) return start;
  if (s >= 1) return end;
  return moved_by(screw, s, start);
}

ScrewMotion screw_motion(const Pose& start, const Pose& end, Vec3 center, double radius) {
  const Screw screw = screw_between(start, end);
  const double rho = screw_radius(screw, center, radius);
  return {start, end, screw, screw_chord_deviation(screw, rho), screw_path_length(screw, rho)};
}

}  // namespace dismantle
