// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/intersect_triangle_triangle.h"
#include "dismantle/narrowphase/penetration_triangle_triangle.h"
#include "dismantle/streams/sweep_engine.h"
#include "tests/support/meshes.h"

#include <limits>
#include <map>
#include <utility>

/// Small scenes with a collision engine over them.
namespace dismantle::scenes {

inline Pose shift(double x, double y, double z) {
  return {{x, y, z}, {}};
}

inline ComponentPair pair_of(std::uint32_t a, std::uint32_t b, PairState state, double allowed) {
  ComponentPair pair;
  pair.a = ComponentId(a);
  pair.b = ComponentId(b);
  pair.state = state;
  pair.allowed_depth = state == PairState::Free ? std::numeric_limits<double>::infinity() : allowed;
  return pair;
}

/// An assembly, its engine, and motions by pose from the assembled state.
class EngineScene {
 public:
  using Parts = std::vector<std::pair<std::string, TriangleMesh>>;
  using Poses = std::map<std::uint32_t, Pose>;

  EngineScene(const Parts& parts, std::vector<ComponentPair> pairs, double tolerance, const CollisionOptions& options)
      : EngineScene(assembly_of(parts), std::move(pairs), tolerance, options) {}
  EngineScene(Assembly assembly, std::vector<ComponentPair> pairs, double tolerance, const CollisionOptions& options)
      : assembly_(std::move(assembly)),
        engine_(make_streams_engine(assembly_, PairStates{tolerance, std::move(pairs)}, options)) {}

  /// Sweeps the given components to poses; the others do not move.
  SweepResult sweep(const Poses& poses) { return engine_->sweep(with(poses), 0); }
  /// As sweep; commits the motion if it is free.
  SweepResult move(const Poses& poses) {
    SweepResult result = sweep(poses);
    if (result.free) engine_->commit();
    return result;
  }
  void jump(const Poses& poses) { engine_->jump(with(poses)); }

  const Assembly& assembly() const { return assembly_; }
  SweepEngine& engine() { return *engine_; }
  const SweepEngine& engine() const { return *engine_; }

 private:
  static Assembly assembly_of(const Parts& parts) {
    std::vector<Component> components;
    for (const auto& [name, mesh] : parts) components.push_back(component(name, mesh));
    return scenes::assembly(std::move(components));
  }
  std::vector<RigidTransform> with(const Poses& poses) const {
    std::vector<RigidTransform> next(engine_->state().begin(), engine_->state().end());
    for (const auto& [c, pose] : poses) next[c] = transform_from_pose(pose);
    return next;
  }

  Assembly assembly_;
  std::unique_ptr<SweepEngine> engine_;
};

/// The pairs whose surfaces intersect, by testing every triangle pair: Contact within the tolerance, else Free.
inline PairStates states_by_brute_force(const Assembly& assembly, double tolerance) {
  PairStates states;
  states.tolerance = tolerance;
  std::vector<TriangleMesh> meshes;
  for (const Component& c : assembly.components) meshes.push_back(assembled_mesh(c));
  for (std::uint32_t a = 0; a < meshes.size(); ++a) {
    for (std::uint32_t b = a + 1; b < meshes.size(); ++b) {
      double depth = -1;
      for (std::size_t f = 0; f < meshes[a].faces.size(); ++f) {
        for (std::size_t g = 0; g < meshes[b].faces.size(); ++g) {
          const Triangle x = meshes[a].triangle(f), y = meshes[b].triangle(g);
          if (!intersect_triangle_triangle(x, y)) continue;
          const double d = penetration_triangle_triangle(x, y).depth;
          depth = d > depth ? d : depth;
        }
      }
      if (depth < 0) continue;
      states.pairs.push_back(pair_of(a, b, depth <= tolerance ? PairState::Contact : PairState::Free, tolerance));
    }
  }
  return states;
}

}  // namespace dismantle::scenes
