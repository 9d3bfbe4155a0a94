// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/ghosts/find_guards.h"
#include "dismantle/engine/pair_rules.h"
#include "dismantle/streams/sweep_engine.h"
#include "dismantle/surface/assembly_triangles.h"
#include "dismantle/surface/solid_shape.h"

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace dismantle {

/// The ghost surfaces of all components (docs/design/0012-ghost-surfaces.md), as the narrow phase takes them.
struct GhostVertices {
  /// Displaced positions of all vertices, in the order of AssemblyTriangles; then those of the vertices of components
  /// whose pairs have ghosts of their own (PairRule) [mm, assembled].
  std::vector<Vec3> displaced;
  /// By how much the bounds of each leaf are grown: no ghost of it is displaced further [mm], shape [leaf_count].
  std::vector<float> margins;
};

/// The guards of all component pairs that are not free: their ghost surfaces and rules, the pairs whose depth is
/// bounded since no ghosts were found for them, and which of those that touch or overlap in the assembled state have
/// been apart.
class GuardedPairs {
 public:
  /// All components in the assembled state. @param assembly must outlive this
  GuardedPairs(const Assembly& assembly, const PairStates& states, const AssemblyTriangles& triangles,
               const CollisionOptions& options);

  /// The ghost surfaces.
  const GhostVertices& ghosts() const { return ghosts_; }
  /// The rules of all pairs at present, the free ones included.
  PairRulesView rules() const { return rules_.view(); }
  /// Ends the free state of a pair. @pre a < b; it was free
  void end_free(ComponentId a, ComponentId b) { rules_.set(a, b, {PairTest::Certified}); }
  /// The pairs that have an allowance of their own, as they have not been apart yet; without free ones.
  std::vector<ComponentPair> overlapping() const;

  /// The contacts of the pairs whose depth is bounded, during a motion on which the points of the one component move
  /// linearly in the frame of the other one. @param start, end world from assembled, shape [component_count]
  std::vector<BlockingPair> too_deep(Span<const RigidTransform> start, Span<const RigidTransform> end) const;
  /// Chooses the sides of sheets that lie on each other for a motion. @return true if the rules have changed
  bool begin_motion(Span<const RigidTransform> start, Span<const RigidTransform> end);
  /// Parts the pairs that are further apart than the tolerance after a step. @return true if the rules have changed
  bool part(Span<const RigidTransform> start, Span<const RigidTransform> end);
  /// Finds out which pairs have parted in a state. @return true if the rules have changed
  bool jump(Span<const RigidTransform> state);

 private:
  /// A pair with a guard of its own.
  struct Pair {
    ComponentId a, b;
    GuardedPair guard;
    PairRule rule;      ///< Until it has parted.
    PairRule mirrored;  ///< The same with the mirrored ghosts of two sheets (SheetSides).
  };
  /// What is known of a component that touches or overlaps another one.
  struct Solid {
    SolidTree tree, ghost;
    std::shared_ptr<const SolidShape> shape;  ///< Null until it is needed.
  };

  void make_usual_ghosts(const PairStates& states, const AssemblyTriangles& triangles, const CollisionOptions& options);
  void find_own_ghosts(const PairStates& states, const AssemblyTriangles& triangles, const Executor& executor);
  void add_own_ghost(ComponentId c, const std::vector<Vec3>& displaced, const AssemblyTriangles& triangles);
  void displace(ComponentId c, Span<const Vec3> displaced, std::size_t offset, const AssemblyTriangles& triangles);
  const SolidShape& shape(ComponentId c);
  bool apart(const Pair& pair, Span<const RigidTransform> state);
  bool usual_ghosts_apart(const Pair& pair, Span<const RigidTransform> state);
  ComponentAt placed(ComponentId c, Span<const RigidTransform> state);
  bool set_parted(Pair& pair, bool parted);
  void set_rule(const Pair& pair);

  const Assembly& assembly_;
  double tolerance_;
  PairRules rules_;
  GhostVertices ghosts_;
  std::vector<Pair> pairs_;
  std::map<ComponentId, Solid> solids_;
};

}  // namespace dismantle
