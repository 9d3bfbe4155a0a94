// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/certificates/front/certificate_front.h"
#include "dismantle/certificates/sweep/bounding_spheres.h"
#include "dismantle/exec/executor.h"
#include "dismantle/surface/solid_tree.h"

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace dismantle {

/// The trees of an assembly's components, and the fronts between pairs of them, which are kept between sweeps.
class FrontStore {
 public:
  /// Builds all trees. The assembly must outlive the store.
  FrontStore(const Assembly& assembly, const Executor& executor);

  /// The tree of a component.
  const SolidTree& solid(ComponentId c) const { return solids_[c.value]; }
  /// The bounding spheres of all components.
  const BoundingSpheres& spheres() const { return spheres_; }

  /// A new front of two components: the pair of the roots; `a` moves.
  CertificateFront new_front(ComponentId a, ComponentId b, SideRule sides) const;
  /// The stored front of two components, made ready for a sweep: created if there is none, its roles exchanged if the
  /// other component moved in its last sweep, its certificates invalidated if the fixed one was moved since.
  /// @param poses of all components
  CertificateFront& prepare(ComponentId moving, ComponentId fixed, SideRule sides, Span<const Pose> poses);
  /// The stored front of two components if a sweep could use it as it is; else null.
  const CertificateFront* find(ComponentId moving, ComponentId fixed, const Pose& pose_fixed) const;
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

  std::vector<SolidTree> solids_;
  BoundingSpheres spheres_;
  std::map<PairKey, Entry> fronts_;
  std::map<PairKey, std::vector<ThreadMatch>> threads_;  ///< Pairs without mating threads have no entry.
};

}  // namespace dismantle
