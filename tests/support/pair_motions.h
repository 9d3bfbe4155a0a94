// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/radial_separation.h"
#include "dismantle/math/screw.h"

namespace dismantle::scenes {

/// The motion of a component relative to one that rests in its assembled pose, between the frames of their trees.
inline PairMotion pair_motion(const ObbTree& moving, const ObbTree& fixed, const Pose& start, const Pose& end) {
  const auto between = [&](const Pose& pose) {
    const RigidTransform t = transform_from_pose(pose);
    return RigidTransform{t.rotation, t * moving.origin - fixed.origin};
  };
  PairMotion motion;
  motion.t0 = between(start);
  motion.t1 = between(end);
  motion.middle = motion.t0.rotation;
  motion.back = screw_between(inverse(start), inverse(end));
  motion.back.reference -= moving.origin;
  return motion;
}

}  // namespace dismantle::scenes
