// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/step_margin.h"

#include "dismantle/math/screw.h"
#include "dismantle/planner/search/motion_validator.h"

#include <algorithm>
#include <atomic>
#include <mutex>

namespace dismantle {

namespace {

/// Distances along a motion are found to within this share of its length, where that is more than half the tolerance.
constexpr double kShareOfMotion = 1e-3;
/// Removed components are parked at this distance, and exits lead as far as kWayOut, in diagonals of the assembly.
constexpr double kFarAway = 100, kWayOut = 1;

/// A part of one screw motion, and the distances at its ends.
struct Part {
  double from = 0, to = 1;  // shares of the motion
  double at_from = 0, at_to = 0;
};

/// Finds margins of steps, one after another.
class MarginFinder {
 public:
  MarginFinder(const Assembly& assembly, const PairStates& pairs, const CertificateOptions& options,
               const RigidGroups& single, const KeepGoing& keep_going)
      : assembly_(assembly),
        pairs_(pairs),
        keep_going_(keep_going),
        size_(diagonal(assembled_bounds(assembly))),
        validator_(assembly, pairs, options, single, kFarAway * size_, keep_going) {}

  /// None if the search was ended.
  std::optional<StepMargin> of(const Plan& plan, std::size_t k);

 private:
  /// The components from among which a step removes its own.
  ComponentSet present_at(const Plan& plan, std::size_t k) const {
    const std::size_t count = assembly_.components.size();
    const std::uint32_t body = plan.steps[k].part_of;
    ComponentSet present =
        body == PlanStep::kWhole ? ComponentSet::all(count) : ComponentSet(count, plan.steps[body].components);
    for (std::size_t j = 0; j < k; ++j)
      if (plan.steps[j].part_of == body) present.erase(plan.steps[j].components);
    return present;
  }

  const Assembly& assembly_;
  const PairStates& pairs_;
  const KeepGoing& keep_going_;
  double size_;  // of the assembly [mm]
  MotionValidator validator_;
};

std::optional<StepMargin> MarginFinder::of(const Plan& plan, std::size_t k) {
  const PlanStep& step = plan.steps[k];
  ComponentSet others = present_at(plan, k);
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
  poses.push_back({last.position + kWayOut * size_ * step.exit, last.rotation});
  double before = distance_at(poses.front());
  for (std::size_t i = 1; i < poses.size() && nearest > 0; ++i) {
    const ScrewMotion motion =
        screw_motion(poses[i - 1], poses[i], transform_from_pose(poses[i - 1]) * box.center(), radius);
    const double resolution = std::max(pairs_.tolerance / 2, kShareOfMotion * motion.path_length);
    const double after = distance_at(poses[i]);
    std::vector<Part> parts{{0, 1, before, after}};
    while (!parts.empty()) {
      if (!keep_going_()) return std::nullopt;
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

}  // namespace

void find_margins(const Assembly& assembly, const PairStates& pairs, const CertificateOptions& options,
                  const ProgressCallback& progress, Plan& plan) {
  const RigidGroups single(assembly.components.size());
  std::vector<std::optional<StepMargin>> found(plan.steps.size());
  std::atomic<std::size_t> next = 0;
  std::mutex progress_mutex;
  bool is_over = false;
  const KeepGoing keep_going = [&] {
    const std::lock_guard lock(progress_mutex);
    const double share = std::min(1.0, static_cast<double>(next) / static_cast<double>(found.size() + 1));
    is_over = is_over || !report_progress(progress, "finding margins", share);
    return !is_over;
  };
  const auto threads = static_cast<std::size_t>(options.executor.thread_count());
  options.executor.for_each_heavy(std::min(threads, found.size()), [&](std::size_t) {
    MarginFinder finder(assembly, pairs, options, single, keep_going);
    for (std::size_t k = next++; k < found.size() && keep_going(); k = next++) found[k] = finder.of(plan, k);
  });
  for (std::size_t k = 0; k < found.size(); ++k) plan.steps[k].margin = found[k];
}

}  // namespace dismantle
