// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/put_aside.h"

#include "dismantle/math/screw.h"
#include "dismantle/planner/component_set.h"
#include "dismantle/session/session_path.h"

#include <algorithm>
#include <limits>

namespace dismantle {

namespace {

/// Clearance around parked components, as a share of the assembly's diagonal.
constexpr double kRoom = 0.02;

/// The volume that a box sweeps.
struct SweptBox {
  Aabb box;
  Vec3 way;  ///< [mm]
};

Aabb shifted(const Aabb& box, const Vec3& by) {
  return {box.lower + by, box.upper + by};
}

Aabb all_of(const SweptBox& swept) {
  Aabb box = swept.box;
  box.extend(shifted(swept.box, swept.way));
  return box;
}

struct Interval {
  double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();
  bool empty() const { return from > to; }
};

Interval projected(const Aabb& box, const Vec3& axis) {
  const Vec3 half = 0.5 * (box.upper - box.lower);
  const double center = dot(box.center(), axis);
  const double reach = std::abs(half.x * axis.x) + std::abs(half.y * axis.y) + std::abs(half.z * axis.z);
  return {center - reach, center + reach};
}

/// Along one axis: the distances at which a box moving along `exit` overlaps the swept volume.
Interval overlap_along(const Aabb& box, const Vec3& exit, const SweptBox& swept, const Vec3& axis) {
  const Interval own = projected(box, axis);
  Interval other = projected(swept.box, axis);
  const double way = dot(swept.way, axis), speed = dot(exit, axis);
  other.from += std::min(0.0, way);
  other.to += std::max(0.0, way);
  if (speed == 0) return own.from <= other.to && own.to >= other.from ? Interval{} : Interval{1, 0};
  const double first = (other.from - own.to) / speed, last = (other.to - own.from) / speed;
  return {std::min(first, last), std::max(first, last)};
}

/// The distances along `exit` at which a box overlaps the swept volume: both are convex, and these separating axes
/// suffice.
Interval overlap(const Aabb& box, const Vec3& exit, const SweptBox& swept) {
  Interval all;
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    for (const Vec3& n : {axis, cross(axis, swept.way)}) {
      if (!(length(n) > 0)) continue;
      const Interval one = overlap_along(box, exit, swept, n);
      all = {std::max(all.from, one.from), std::min(all.to, one.to)};
      if (all.empty()) return all;
    }
  }
  return all;
}

/// The smallest distance outside all intervals. @pre none is empty
double first_outside(std::vector<Interval> taken) {
  std::sort(taken.begin(), taken.end(), [](const Interval& a, const Interval& b) { return a.from < b.from; });
  double distance = 0;
  for (const Interval& t : taken)
    if (t.from <= distance) distance = std::max(distance, t.to);
  return distance;
}

class Aside {
 public:
  Aside(const Assembly& assembly, const Plan& plan)
      : assembly_(assembly),
        plan_(plan),
        room_(kRoom * diagonal(assembled_bounds(assembly))),
        distances_(plan.steps.size()) {}

  std::vector<double> find() {
    const std::size_t count = assembly_.components.size();
    arrange(PlanStep::kWhole, Pose{}, ComponentSet::all(count).members(), {{assembled_bounds(assembly_), {}}});
    return std::move(distances_);
  }

 private:
  /// Parks what is removed from a body at `base`, from the last step to the first: each clear of everything that comes
  /// after it.
  /// @return the volumes that all of it sweeps
  std::vector<SweptBox> arrange(std::uint32_t body, const Pose& base, const std::vector<ComponentId>& members,
                                std::vector<SweptBox> passed) {
    ComponentSet staying(assembly_.components.size(), members);
    for (const PlanStep& step : plan_.steps)
      if (step.part_of == body) staying.erase(step.components);
    for (const ComponentId c : staying.members()) passed.push_back({bounds_at(assembly_[c], base), {}});
    for (auto k = static_cast<std::uint32_t>(plan_.steps.size()); k-- > 0;)
      if (plan_.steps[k].part_of == body) put_step(k, base, passed);
    return passed;
  }

  void put_step(std::uint32_t k, const Pose& base, std::vector<SweptBox>& passed) {
    const PlanStep& step = plan_.steps[k];
    const Pose last = step.poses.empty() ? base : base * step.poses.back();
    const Vec3 exit = mat3_from_quat(base.rotation) * step.exit;
    const Aabb leaving = bounds(step, last);
    std::vector<SweptBox> inner;
    if (step.components.size() > 1) inner = arrange(k, last, step.components, {});

    std::vector<Aabb> room{leaving};
    for (const SweptBox& swept : inner) room.push_back(all_of(swept));
    const Aabb start = way_box(step, base);
    passed.push_back({start, {}});
    std::vector<Interval> taken;
    for (const Aabb& box : room) {
      const Aabb roomy = inflated(box, room_);
      for (const SweptBox& other : passed)
        if (const Interval one = overlap(roomy, exit, other); !one.empty()) taken.push_back(one);
    }
    const double distance = distances_[k] = first_outside(std::move(taken));
    passed.push_back({leaving, distance * exit});
    for (SweptBox& swept : inner) {
      swept.box = shifted(swept.box, distance * exit);
      passed.push_back(swept);
    }
  }

  Aabb bounds(const PlanStep& step, const Pose& pose) const {
    Aabb box;
    for (const ComponentId c : step.components) box.extend(bounds_at(assembly_[c], pose));
    return box;
  }

  /// A bounding box of the step's path before the final straight part.
  Aabb way_box(const PlanStep& step, const Pose& base) const {
    Aabb all = bounds(step, base), last = all;
    Pose from = base;
    for (const Pose& pose : step.poses) {
      const Pose to = base * pose;
      const Screw screw = screw_between(from, to);
      const Aabb next = bounds(step, to);
      Aabb passed = last;
      passed.extend(next);
      if (screw.angle > 0)
        passed = inflated(passed,
                          screw_chord_deviation(screw, screw_radius(screw, passed.center(), 0.5 * diagonal(passed))));
      all.extend(passed);
      last = next;
      from = to;
    }
    return all;
  }

  const Assembly& assembly_;
  const Plan& plan_;
  double room_;
  std::vector<double> distances_;
};

}  // namespace

std::vector<double> put_aside(const Assembly& assembly, const Plan& plan) {
  return Aside(assembly, plan).find();
}

}  // namespace dismantle
