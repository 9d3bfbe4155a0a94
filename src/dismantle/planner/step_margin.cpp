// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/step_margin.h"

#include "dismantle/math/screw.h"

#include <algorithm>

namespace dismantle {

namespace {

/// Distances along a motion are found to within this share of its length, where that is more than half the tolerance.
constexpr double kShareOfMotion = 1e-3;

/// A part of one screw motion, and the distances at its ends.
struct Part {
  double from = 0, to = 1;  // shares of the motion
  double at_from = 0, at_to = 0;
};

}  // namespace

StepMargin StepMargins::of(const PlanStep& step, const std::vector<ComponentId>& present, double way) const {
  ComponentSet others(assembly_.components.size(), present);
  const ComponentSet moving(assembly_.components.size(), step.components);
  for (const ComponentPair& pair : pairs_.pairs) {
    if (pair.state == PairState::Near || pair.state == PairState::Clear) continue;
    if (moving.has(pair.a) && !moving.has(pair.b)) others.erase({&pair.b, 1});
    if (moving.has(pair.b) && !moving.has(pair.a)) others.erase({&pair.a, 1});
  }
  validator_.stand(others);

  Aabb box;
  for (const ComponentId c : step.components) box.extend(assembled_bounds(assembly_[c]));
  const double radius = diagonal(box) / 2;
  double nearest = 4 * kMaxMargin * radius;
  StepMargin margin{nearest / 2, {}};
  const auto distance_at = [&](const Pose& pose) {
    const Clearance found = validator_.clearance_at(step.components, pose, nearest);
    if (found.distance >= nearest) return nearest;
    nearest = found.distance;
    margin = {nearest / 2, found.fixed};
    return nearest;
  };

  std::vector<Pose> poses{Pose{}};
  poses.insert(poses.end(), step.poses.begin(), step.poses.end());
  const Pose last = poses.back();
  poses.push_back({last.position + way * step.exit, last.rotation});
  double before = distance_at(poses.front());
  for (std::size_t i = 1; i < poses.size() && nearest > 0; ++i) {
    const ScrewMotion motion =
        screw_motion(poses[i - 1], poses[i], transform_from_pose(poses[i - 1]) * box.center(), radius);
    const double resolution = std::max(pairs_.tolerance / 2, kShareOfMotion * motion.path_length);
    const double after = distance_at(poses[i]);
    std::vector<Part> parts{{0, 1, before, after}};
    while (!parts.empty()) {
      const Part part = parts.back();
      parts.pop_back();
      // No point moves faster than along the whole length: in between, nothing is nearer than this.
      const double moved = (part.to - part.from) * motion.path_length;
      if ((part.at_from + part.at_to - moved) / 2 >= nearest - resolution) continue;
      const double middle = (part.from + part.to) / 2, at_middle = distance_at(motion.at(middle));
      parts.push_back({middle, part.to, at_middle, part.at_to});
      parts.push_back({part.from, middle, part.at_from, at_middle});
    }
    before = after;
  }
  return margin;
}

}  // namespace dismantle
