// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/certificates/front/certificate_front.h"
#include "dismantle/certificates/ghosts/find_guards.h"
#include "dismantle/certificates/sweep/bounding_spheres.h"
#include "dismantle/exec/executor.h"
#include "dismantle/surface/solid_tree.h"

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace dismantle {

/// The one of two components that is represented by its ghost surface.
enum class GhostOf : std::uint8_t { None, First, Second };

/// The trees of an assembly's components and of their ghost surfaces, and the fronts between pairs of them, which are
/// kept between sweeps.
class FrontStore {
 public:
  /// Builds all trees. The assembly must outlive the store.
  /// @param ghost_length largest displacement of a ghost surface [mm]
  FrontStore(const Assembly& assembly, double ghost_length, const Executor& executor);

  /// The tree of a component.
  const SolidTree& solid(ComponentId c) const { return solids_[c.value]; }
  /// The tree of a component's ghost surface with respect to another component: its own, unless the two have a pair of
  /// their own.
  const SolidTree& ghost(ComponentId c, ComponentId other) const;
  /// Gives pairs of components the ghost surfaces of their own that were found for them.
  void set_ghosts(Span<const FoundGuard> guards, const Executor& executor);
  /// Uses the ghosts that two components have of their own, or those that they have against all others.
  void use_own_ghosts(ComponentId a, ComponentId b, bool own);
  /// The bounding spheres of all components.
  const BoundingSpheres& spheres() const { return spheres_; }

  /// A new front of two components: the pair of the roots; `a` moves. @param ghost of `a` or of `b`
  CertificateFront new_front(ComponentId a, ComponentId b, GhostOf ghost) const;
  /// The stored front of two components, made ready for a sweep: created if there is none, its roles exchanged if the
  /// other component moved in its last sweep, its certificates invalidated if the fixed one was moved since.
  /// @param ghost of the moving component or of the fixed one
  /// @param poses of all components
  CertificateFront& prepare(ComponentId moving, ComponentId fixed, GhostOf ghost, Span<const Pose> poses);
  /// The stored front of two components if a sweep could use it as it is; else null.
  const CertificateFront* find(ComponentId moving, ComponentId fixed, GhostOf ghost, const Pose& pose_fixed) const;
  /// Number of node pairs of all fronts between a moving and a fixed component.
  /// @param is_moving of each component
  std::size_t size(const std::vector<bool>& is_moving) const;

 private:
  /// Components a < b.
  using PairKey = std::pair<ComponentId, ComponentId>;
  struct Entry {
    CertificateFront front;
    bool b_moves = false;
    Pose fixed_pose;  ///< Of the fixed component in the last sweep.
  };

  /// Finds mating threads and computes the radial bounds of components with a common axis in the assembled state, so
  /// that no step has to.
  void prepare_radial(const Executor& executor);

  /// Two components a < b, and the one of which the ghost is meant.
  using FrontKey = std::pair<PairKey, GhostOf>;
  static FrontKey key_of(ComponentId x, ComponentId y, GhostOf ghost);

  std::vector<SolidTree> solids_, ghosts_;
  struct PairTrees {
    SolidTree ghosts[2];
    bool in_use = true;
  };
  std::map<PairKey, PairTrees> pair_ghosts_;  ///< Pairs that have some of their own.
  BoundingSpheres spheres_;
  std::map<FrontKey, Entry> fronts_;
  std::map<FrontKey, std::vector<ThreadMatch>> threads_;  ///< Pairs without mating threads have no entry.
};

}  // namespace dismantle
