// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/explorer.h"

namespace dismantle {

StepResult Explorer::slide(const Pose& target) {
  StepResult made = maker_.slide(target);
  for (const CollisionContact& c : made.contacts) met_.insert(c.a == component_ ? c.b : c.a);
  for (const ContactPoint& c : made.touching) met_.insert(c.fixed);
  return made;
}

bool Explorer::exits(const Vec3& direction, double way) {
  const StepMaker::Trial trial = maker_.try_exit(direction, way);
  for (const auto& [moving, fixed] : trial.against) met_.insert(fixed);
  return trial.free;
}

}  // namespace dismantle
