// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/engine/contact.h"
#include "dismantle/engine/vertex_motion.h"
#include "dismantle/engine/watched_spheres.h"
#include "dismantle/exec/executor.h"

#include <functional>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace dismantle {

/// Enforces the second rule of the guarantee (docs/guarantee.md) where triangle pairs cannot: no vertex of a component
/// gets deeper than twice the pair's allowance inside another closed component.
///
/// A triangle that is thinner than the allowance is never "too deep" in another such, so a finely tessellated surface,
/// or one of slivers, would be permeable for the pair. The guard watches the vertices of such pairs by their signed
/// distance to the other surface, which changes by at most the path that they travel. Vertices far from the other
/// surface are watched by spheres: each keeps the slack found last, reduced by the path since then, and is evaluated
/// again (and divided, near the surface) only if its slack may be used up.
class VertexDepthGuard {
 public:
  /// Allowed depth of a vertex, in multiples of the allowed penetration of triangles.
  static constexpr double kLimit = 2;

  /// Gives the solid of a component, which must outlive the guard.
  using SolidOf = std::function<const SolidTree&(ComponentId)>;

  /// Watches the Fit pairs, and the Contact pairs that overlap or have a triangle whose smallest altitude is below
  /// twice the allowance. All components are in the assembled state.
  /// @param assembly must outlive the guard
  VertexDepthGuard(const Assembly& assembly, const PairStates& pairs, SolidOf solid_of, const Executor& executor);

  /// Computes what pairs considered later may need, so that no step has to.
  void prepare();
  /// Watches this pair, too, if it has such thin triangles; does nothing if it was considered before.
  /// @param allowed its allowed penetration [mm]
  void consider(ComponentId a, ComponentId b, double allowed);

  /// True if there are no pairs to watch.
  bool watches_nothing() const { return watched_.empty(); }

  /// The vertices that get too deep on the motion between two states, one transform a component, each pair along one
  /// relative screw: at most one blocking pair for each pair of components, up to whose toi all its vertices are
  /// certainly allowed.
  std::vector<BlockingPair> sweep(Span<const RigidTransform> from, Span<const RigidTransform> to);
  /// The same if only the pairs of components in `near` may meet during the motion: all others are known to be apart.
  std::vector<BlockingPair> sweep(Span<const RigidTransform> from, Span<const RigidTransform> to,
                                  Span<const std::pair<ComponentId, ComponentId>> near);
  /// Makes the end of the last sweep the present state. @pre that sweep found nothing
  void commit();
  /// Forgets all slacks, as the state was changed without a sweep.
  void jump();

 private:
  using MayMeet = std::function<bool(const WatchedComponent&)>;
  void watch(ComponentId inner, ComponentId outer, double allowed);
  double min_altitude_of(ComponentId component);
  const VertexTree& tree_of(ComponentId component);
  std::vector<BlockingPair> sweep_pairs(Span<const RigidTransform> from, Span<const RigidTransform> to,
                                        const MayMeet& may_meet);
  DeepVertexTime sweep_pair(WatchedComponent& watched, const VertexMotion& motion) const;

  const Assembly* assembly_;
  SolidOf solid_of_;
  double tolerance_, max_allowance_;
  std::vector<double> min_altitudes_;  ///< Smallest altitude of a component's triangles [mm]; negative: not known yet.
  std::vector<std::shared_ptr<const VertexTree>> trees_;  ///< Of each component; null: not needed yet.
  std::set<std::pair<ComponentId, ComponentId>> considered_;
  std::vector<WatchedComponent> watched_;
  Executor executor_;
};

/// The solids of an assembly, each built when it is first used. @param assembly must outlive the function returned
VertexDepthGuard::SolidOf solids_of(const Assembly& assembly, const Executor& executor);

}  // namespace dismantle
