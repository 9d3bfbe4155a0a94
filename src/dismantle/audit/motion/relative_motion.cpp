// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/motion/relative_motion.h"

namespace dismantle::audit {

RigidTransform RelativeMotion::at(double s) const {
  if (s == 0) return start;
  return transform_from_pose(screw_at(screw, s)) * start;
}

RelativeMotion relative_motion(const RigidTransform& world_from_a, const RigidTransform& world_from_b,
                               const Screw& world_screw) {
  const RigidTransform a_from_world = inverse(world_from_a);
  const Vec3 origin_offset = world_from_a.translation - world_screw.reference;
  const Vec3 velocity_of_origin = world_screw.velocity + cross(world_screw.angle * world_screw.axis, origin_offset);

  RelativeMotion motion;
  motion.start = {a_from_world.rotation * world_from_b.rotation,
                  a_from_world.rotation * (world_from_b.translation - world_from_a.translation)};
  motion.screw.velocity = a_from_world.rotation * velocity_of_origin;
  motion.screw.axis = a_from_world.rotation * world_screw.axis;
  motion.screw.angle = world_screw.angle;
  return motion;
}

RelativeMotion reversed_roles(const RelativeMotion& motion) {
  // start^-1 exp(-s twist) = exp(-s Ad(start^-1) twist) start^-1
  RelativeMotion reversed;
  reversed.start = inverse(motion.start);
  reversed.screw.velocity = -(reversed.start.rotation * motion.velocity(motion.start.translation));
  reversed.screw.axis = -(reversed.start.rotation * motion.screw.axis);
  reversed.screw.angle = motion.screw.angle;
  return reversed;
}

}  // namespace dismantle::audit
