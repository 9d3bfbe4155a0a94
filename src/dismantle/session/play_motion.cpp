// SPDX-License-Identifier: Apache-2.0
#include "dismantle/session/play_motion.h"

#include <algorithm>

namespace dismantle {

namespace {

Path empty_path(const Assembly& assembly, const PairStates& states) {
  Path path;
  path.assembly_file = assembly.source_file;
  path.assembly_sha256 = assembly.source_sha256;
  for (const Component& c : assembly.components) path.components.push_back(c.name);
  path.tolerance = states.tolerance;
  for (const ComponentPair& p : states.pairs) {
    if (p.state != PairState::Fit && p.state != PairState::Embedded) continue;
    path.pairs.push_back({assembly[p.a].name, assembly[p.b].name, p.state, p.allowed_penetration});
  }
  return path;
}

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

/// Adds the frames of one step: the screws that it was cut into share its time evenly.
void append_frames(Move& move, double time, const StepResult& step) {
  const double before = move.frames.back().time;
  const auto count = static_cast<double>(step.way.size());
  for (std::size_t i = 0; i + 1 < step.way.size(); ++i)
    move.frames.push_back({before + (time - before) * (static_cast<double>(i) + 1) / count, step.way[i]});
  // The first frame already says where the set starts: a first target that asks for just that adds none.
  if (move.frames.size() > 1 || time > 0 || !step.way.empty()) move.frames.push_back({time, step.pose});
}

Aabb bounds_at(const Component& component, const Pose& pose) {
  const RigidTransform now = transform_from_pose(pose) * component.assembly_from_mesh;
  Aabb box;
  for (const Vec3& p : component.mesh->vertices) box.extend(now * p);
  return box;
}

std::vector<std::string> removed_components(const Assembly& assembly, Span<const Pose> poses) {
  const Aabb all = assembled_bounds(assembly);
  std::vector<std::string> names;
  for (std::size_t c = 0; c < poses.size(); ++c)
    if (!(poses[c] == Pose{}) && !overlaps(all, bounds_at(assembly.components[c], poses[c])))
      names.push_back(assembly.components[c].name);
  return names;
}

}  // namespace

Result<PlayedMotion> play_motion(const Assembly& assembly, const PairStates& states, const Motion& motion,
                                 MotionEngine& engine, const ProgressCallback& progress) {
  PlayedMotion played;
  played.path = empty_path(assembly, states);
  std::size_t target_count = 0;
  for (const MotionMove& move : motion.moves) target_count += move.targets.size();

  for (std::size_t m = 0; m < motion.moves.size() && !played.cancelled; ++m) {
    const MotionMove& asked = motion.moves[m];
    const Result<std::vector<ComponentId>> set = find_set(assembly, asked, m, engine.poses());
    if (!set) return set.error();
    engine.hold(*set);
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
