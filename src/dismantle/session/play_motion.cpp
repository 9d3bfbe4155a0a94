// SPDX-License-Identifier: Apache-2.0
#include "dismantle/session/play_motion.h"

#include "dismantle/session/session_path.h"

#include <algorithm>

namespace dismantle {

namespace {

Result<std::vector<ComponentId>> find_set(const Assembly& assembly, const MotionMove& move, std::size_t index,
                                          Span<const Pose> poses) {
  const std::string where = "moves[" + std::to_string(index) + "]";
  std::vector<ComponentId> ids;
  for (const std::string& name : move.components) {
    const std::optional<ComponentId> id = assembly.find(name);
    if (!id)
      return Error{ErrorKind::Usage, std::string(where)
                                         .append(" moves an unknown component (the assembly has no '")
                                         .append(name)
                                         .append("'); 'dismantle info' lists the names")};
    if (std::find(ids.begin(), ids.end(), *id) == ids.end()) ids.push_back(*id);
  }
  if (ids.empty()) return Error{ErrorKind::Usage, where + " moves nothing (components is empty); name at least one"};
  for (const ComponentId id : ids) {
    if (poses[id.value] == poses[ids.front().value]) continue;
    return Error{ErrorKind::Usage, where + " cannot move its components as one body ('" + assembly[id].name +
                                       "' and '" + assembly[ids.front()].name +
                                       "' were moved apart before); move them one after another"};
  }
  return ids;
}

/// Adds the frames of one target: at least one, except for a first target that equals the start pose.
void append_frames(Move& move, double time, const StepResult& step) {
  append_step_frames(move.frames, time, step);
  if (step.poses.empty() && (move.frames.size() > 1 || time > 0)) move.frames.push_back({time, step.pose});
}

}  // namespace

Result<PlayedMotion> play_motion(const Assembly& assembly, const PairStates& states, const Motion& motion,
                                 MotionEngine& engine, const ProgressCallback& progress) {
  PlayedMotion played;
  PairStates allowed = states;
  allowed.raise_allowances(engine.overlapping_pairs());
  played.path = empty_path(assembly, allowed);
  std::size_t target_count = 0;
  for (const MotionMove& move : motion.moves) target_count += move.targets.size();

  for (std::size_t m = 0; m < motion.moves.size() && !played.cancelled; ++m) {
    const MotionMove& asked = motion.moves[m];
    const Result<std::vector<ComponentId>> set = find_set(assembly, asked, m, engine.poses());
    if (!set) return set.error();
    engine.grab(*set);
    Move move{"move " + assembly[set->front()].name, asked.components, {{0, engine.poses()[set->front().value]}}};

    for (std::size_t k = 0; k < asked.targets.size(); ++k) {
      const double done = static_cast<double>(played.steps.size()) / static_cast<double>(target_count);
      if (!report_progress(progress, "moving", done)) {
        played.cancelled = true;
        break;
      }
      const Frame& target = asked.targets[k];
      PlayedStep step{m, k, target.time, engine.step(target.pose, motion.response)};
      append_frames(move, target.time, step.result);
      played.steps.push_back(std::move(step));
    }
    played.path.moves.push_back(std::move(move));
  }
  played.path.removed = removed_components(assembly, engine.poses());
  report_progress(progress, "moving", 1);
  return played;
}

}  // namespace dismantle
