// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/rigid_transform.h"

#include <vector>

namespace dismantle::families {

/// Poses of a body of which each follows the one before by one screw, by formulas of its own.
class ScrewTrack {
 public:
  /// @param poses at the times 0, 1, 2, ...; at least one
  explicit ScrewTrack(std::vector<Pose> poses);
  /// The track of a standing body as seen from the moving one.
  ScrewTrack seen_from_body() const;

  double end() const { return static_cast<double>(poses_.size() - 1); }
  std::size_t count() const { return poses_.size(); }
  const Pose& pose(std::size_t k) const { return poses_[k]; }
  /// The pose at any time.
  RigidTransform at(double time) const;
  /// The angle of the screw that begins at a pose [rad].
  double angle(std::size_t k) const { return screws_[k].angle; }

 private:
  /// x -> R(s angle) x + shift(s), after the pose at its begin.
  struct OwnScrew {
    Vec3 axis;         // unit
    double angle = 0;  // in [0, pi]
    Vec3 along, across, aside;
  };
  static OwnScrew between(const Pose& from, const Pose& to);

  std::vector<Pose> poses_;
  std::vector<OwnScrew> screws_;
  bool inverted_ = false;
};

}  // namespace dismantle::families
