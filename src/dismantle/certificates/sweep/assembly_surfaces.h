// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/certificates/front/thread_separation.h"
#include "dismantle/certificates/ghosts/find_guards.h"
#include "dismantle/certificates/sweep/bounding_spheres.h"
#include "dismantle/surface/solid_tree.h"

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace dismantle {

/// The one of two components that is represented by its ghost surface; mirrored for sheets (SheetSides).
enum class GhostOf : std::uint8_t { None, First, Second, FirstMirrored, SecondMirrored };

/// Two components a < b.
using PairKey = std::pair<ComponentId, ComponentId>;
/// Two components a < b, and the one of which the ghost is meant.
using FrontKey = std::pair<PairKey, GhostOf>;

/// The surfaces that the engines of an assembly share: the trees of its components and of their ghost surfaces, and the
/// guards of pairs in the assembled state. Immutable; may be shared by engines on any threads.
class AssemblySurfaces {
 public:
  using SharedTree = std::shared_ptr<const SolidTree>;    ///< A tree that several may use.
  using SharedShape = std::shared_ptr<const SolidShape>;  ///< A shape that several may use.

  /// The guard of a pair, and the surfaces that it needs.
  struct PairSurfaces {
    GuardedPair guard;       ///< Not parted.
    SharedTree ghosts[2];    ///< Of both components, where they have ghosts of their own; else null.
    SharedTree mirrored[2];  ///< Those on the other sides of two sheets (SheetSides); else null.
    /// The mating threads of either ghost and the other component; null where they have no ghosts of their own.
    std::shared_ptr<const std::vector<ThreadMatch>> threads[2];
  };

  /// Prepares everything. Components and pairs that `options.prepared` has in the same place, with the same allowances,
  /// are taken from there; the result does not depend on it. Keeps a copy of `assembly`.
  /// @param options executor, lanes, keep_going and prepared
  AssemblySurfaces(const Assembly& assembly, const PairStates& pairs, const CertificateOptions& options = {});

  /// The assembly.
  const Assembly& assembly() const { return assembly_; }
  /// The tolerance [mm].
  double tolerance() const { return pairs_.tolerance; }
  /// The tree of a component.
  const SolidTree& solid(ComponentId c) const { return *components_[c.value].solid; }
  /// The shape of a component, built when it is first wanted.
  const SharedShape& shape(ComponentId c, const Executor& executor) const { return shapes_.of(c, executor); }
  /// The tree of the ghost surface that a component has against all others.
  const SolidTree& ghost(ComponentId c) const { return *components_[c.value].ghost; }
  /// The pairs with a guard of their own.
  const std::map<PairKey, PairSurfaces>& pairs() const { return guarded_; }
  /// The ghost surfaces that two components a < b have of their own, of a and of b; null where they have none.
  const SharedTree* own_ghosts(const PairKey& pair) const;
  /// The same, mirrored. @pre the guard's SheetSides has both
  const SharedTree* mirrored_ghosts(const PairKey& pair) const { return guarded_.at(pair).mirrored; }
  /// The mating threads of the surfaces that components have against all others.
  Span<const ThreadMatch> threads(const FrontKey& key) const;
  /// The mating threads of the ghost surface that one of two components has against the other one alone, and of that
  /// other one. @pre own_ghosts() are not null
  Span<const ThreadMatch> own_threads(const FrontKey& key) const;
  /// The bounding spheres of all components.
  const BoundingSpheres& spheres() const { return spheres_; }

 private:
  struct ComponentSurfaces {
    SharedTree solid, ghost;
    BoundingSphere sphere;
  };
  /// The components that another assembly has in the same place: their ids there, ascending where that is possible, or
  /// invalid.
  std::vector<ComponentId> find_prepared(const AssemblySurfaces& prepared) const;
  void prepare_components(const Executor& executor);
  ComponentSurfaces prepare_component(const Component& component, const Executor& executor) const;
  /// Finds mating threads and computes the radial bounds of components with a common axis in the assembled state, so
  /// that no step has to.
  void prepare_radial(const Executor& executor);
  void prepare_pairs(const CertificateOptions& options);
  /// Takes the guard of a pair from those prepared. @return false if it is not known
  bool take_prepared(const ComponentPair& pair, bool incomplete_too);
  /// Stores guards and builds the ghost surfaces that belong to single pairs.
  void add_guards(std::vector<FoundGuard> guards, const Executor& executor);

  Assembly assembly_;
  PairStates pairs_;                                      // as given
  std::atomic<bool> complete_ = true;                     // the search for ghosts was not ended early
  std::shared_ptr<const AssemblySurfaces> prepared_;      // null once everything is prepared
  std::vector<ComponentId> prepared_as_;                  // of each component in `prepared_`
  std::vector<ComponentSurfaces> components_;             // of each component
  LazyShapes shapes_;                                     // of all components
  BoundingSpheres spheres_;                               // of all components
  std::map<PairKey, PairSurfaces> guarded_;               // pairs with a guard of their own
  std::map<FrontKey, std::vector<ThreadMatch>> threads_;  // pairs without mating threads have no entry
};

}  // namespace dismantle
