// SPDX-License-Identifier: Apache-2.0
#include "bench/families/screw_track.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dismantle::families {

namespace {

Vec3 rotated(Vec3 axis, double angle, Vec3 p) {
  const double c = std::cos(angle), s = std::sin(angle);
  return c * p + s * cross(axis, p) + (1 - c) * dot(axis, p) * axis;
}

}  // namespace

ScrewTrack::ScrewTrack(std::vector<Pose> poses) : poses_(std::move(poses)) {
  for (std::size_t k = 0; k + 1 < poses_.size(); ++k) screws_.push_back(between(poses_[k], poses_[k + 1]));
}

ScrewTrack ScrewTrack::seen_from_body() const {
  ScrewTrack track = *this;
  track.inverted_ = !inverted_;
  return track;
}

ScrewTrack::OwnScrew ScrewTrack::between(const Pose& from, const Pose& to) {
  Quat q = to.rotation * conjugate(from.rotation);
  if (q.w < 0) q = -q;
  const Vec3 v{q.x, q.y, q.z};
  OwnScrew screw;
  const double sine = length(v);
  if (sine < 1e-13) {
    screw.along = to.position - from.position;
    return screw;
  }
  screw.axis = v / sine;
  screw.angle = 2 * std::atan2(sine, q.w);
  const Vec3 shift = to.position - rotated(screw.axis, screw.angle, from.position);
  screw.along = dot(shift, screw.axis) * screw.axis;
  const Vec3 t = shift - screw.along;
  // The rate w of the shift across the axis: t = (sin a / a) w + ((1 - cos a) / a) axis x w.
  const double half = screw.angle / 2;
  screw.across = half * (t / std::tan(half) - cross(screw.axis, t));
  screw.aside = cross(screw.axis, screw.across);
  return screw;
}

RigidTransform ScrewTrack::at(double time) const {
  const auto k = static_cast<std::size_t>(std::clamp(time, 0.0, end()));
  const double s = time - static_cast<double>(k);
  RigidTransform pose = transform_from_pose(poses_[k]);
  if (s > 0 && k < screws_.size()) {
    const OwnScrew& screw = screws_[k];
    const double turn = s * screw.angle;
    Vec3 shift = s * screw.along;
    if (screw.angle > 0)
      shift = shift + (std::sin(turn) / screw.angle) * screw.across +
              (2 * std::sin(turn / 2) * std::sin(turn / 2) / screw.angle) * screw.aside;
    const RigidTransform step{screw.angle > 0 ? mat3_from_quat(quat_about(screw.axis, turn)) : Mat3{}, shift};
    pose = step * pose;
  }
  return inverted_ ? inverse(pose) : pose;
}

}  // namespace dismantle::families
