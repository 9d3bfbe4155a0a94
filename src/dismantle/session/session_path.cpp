// SPDX-License-Identifier: Apache-2.0
#include "dismantle/session/session_path.h"

namespace dismantle {

Path empty_path(const Assembly& assembly, const PairStates& states) {
  Path path;
  path.assembly_file = assembly.source_file;
  path.assembly_sha256 = assembly.source_sha256;
  for (const Component& c : assembly.components) path.components.push_back(c.name);
  path.tolerance = states.tolerance;
  for (const ComponentPair& p : states.pairs) {
    if (p.allowed_depth <= states.tolerance) continue;
    PathPair pair{assembly[p.a].name, assembly[p.b].name, PathPairState::Overlapping, p.depth, p.allowed_depth};
    if (p.declared > 0) pair.state = PathPairState::Declared;
    if (p.state == PairState::Free) pair.state = PathPairState::Free;
    path.pairs.push_back(pair);
  }
  return path;
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

void append_step_frames(std::vector<Frame>& frames, double time, const StepResult& step) {
  const double before = frames.back().time;
  const auto count = static_cast<double>(step.poses.size());
  for (std::size_t i = 0; i + 1 < step.poses.size(); ++i)
    frames.push_back({before + (time - before) * (static_cast<double>(i) + 1) / count, step.poses[i]});
  if (!step.poses.empty()) frames.push_back({time, step.pose});
}

}  // namespace dismantle
