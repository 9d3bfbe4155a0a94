// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/gltf/glb_keys.h"

#include "dismantle/math/screw.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dismantle {

namespace {

constexpr double kLargestTurn = 1.0;  // between two keys [rad]: well below pi, where the short way is not decided

/// The number of linear pieces that approximate the path of a mesh's origin along the screw.
int piece_count(const Pose& start, const Pose& end, Vec3 origin) {
  const Screw screw = screw_between(start, end);
  if (screw.angle == 0) return 1;
  const double rho = screw_radius(screw, transform_from_pose(start) * origin, 0);
  const double by_way = std::sqrt(screw_chord_deviation(screw, rho) / kGlbDeviation);
  return static_cast<int>(std::ceil(std::max({1.0, by_way, screw.angle / kLargestTurn})));
}

class KeyWriter {
 public:
  explicit KeyWriter(const RigidTransform& placement)
      : origin_(placement.translation), turn_(quat_from_mat3(placement.rotation)) {}

  void add(const Frame& frame) {
    auto time = static_cast<float>(frame.time);
    if (!keys_.times.empty())
      time = std::max(time, std::nextafter(keys_.times.back(), std::numeric_limits<float>::infinity()));
    keys_.times.push_back(time);

    const Vec3 place = kMetresPerMillimetre * (transform_from_pose(frame.pose) * origin_);
    for (int k = 0; k < 3; ++k) keys_.translations.push_back(static_cast<float>(place[k]));

    Quat turn = normalized(frame.pose.rotation * turn_);
    if (keys_.times.size() > 1 && dot(turn, last_) < 0) turn = -turn;
    last_ = turn;
    for (const double part : {turn.x, turn.y, turn.z, turn.w}) keys_.rotations.push_back(static_cast<float>(part));
  }

  GlbKeys take() { return std::move(keys_); }

 private:
  Vec3 origin_;
  Quat turn_, last_;
  GlbKeys keys_;
};

}  // namespace

GlbKeys glb_keys(const RigidTransform& assembly_from_mesh, Span<const Frame> frames) {
  DISMANTLE_EXPECT(!frames.empty());
  KeyWriter keys(assembly_from_mesh);
  keys.add(frames[0]);
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const Frame &before = frames[i - 1], &frame = frames[i];
    const bool rests = frame.pose == before.pose;
    const bool rests_on = i + 1 < frames.size() && frames[i + 1].pose == frame.pose;
    if (rests && (rests_on || frame.time == before.time)) continue;
    const int pieces = rests ? 1 : piece_count(before.pose, frame.pose, assembly_from_mesh.translation);
    for (int k = 1; k < pieces; ++k) {
      const double share = static_cast<double>(k) / pieces;
      keys.add({before.time + share * (frame.time - before.time), pose_between(before.pose, frame.pose, share)});
    }
    keys.add(frame);
  }
  return keys.take();
}

}  // namespace dismantle
