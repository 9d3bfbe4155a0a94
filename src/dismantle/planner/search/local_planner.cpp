// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/local_planner.h"

namespace dismantle {

StepResult LocalPlanner::slide(const Pose& target) {
  StepResult made = validator_.slide(target);
  for (const BlockingPair& c : made.blocking_pairs) met_.insert(validator_.moves(c.a) ? c.b : c.a);
  for (const ContactPoint& c : made.contact_points) met_.insert(c.fixed);
  return made;
}

bool LocalPlanner::exits(const Vec3& direction, double way) {
  const MotionValidator::Trial trial = validator_.try_exit(direction, way);
  for (const auto& [moving, fixed] : trial.against) met_.insert(fixed);
  return trial.free;
}

}  // namespace dismantle
