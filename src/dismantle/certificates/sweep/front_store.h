// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/certificate_front.h"
#include "dismantle/certificates/sweep/assembly_surfaces.h"

#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace dismantle {

/// The fronts between pairs of an assembly's components, which are kept between sweeps.
class FrontStore {
 public:
  /// No fronts yet. @param surfaces never null
  explicit FrontStore(std::shared_ptr<const AssemblySurfaces> surfaces) : surfaces_(std::move(surfaces)) {}

  /// The surfaces.
  const std::shared_ptr<const AssemblySurfaces>& surfaces() const { return surfaces_; }
  /// The tree of a component.
  const SolidTree& solid(ComponentId c) const { return surfaces_->solid(c); }
  /// The tree of a component's ghost surface with respect to another component: its own, unless the two have a pair of
  /// their own.
  const SolidTree& ghost(ComponentId c, ComponentId other) const;
  /// The mirrored one of two sheets. @pre the pair has them
  const SolidTree& mirrored_ghost(ComponentId c, ComponentId other) const {
    return *surfaces_->mirrored_ghosts(std::minmax(c, other))[c < other ? 0 : 1];
  }
  /// Uses the ghosts that two components have of their own, or those that they have against all others.
  void use_own_ghosts(ComponentId a, ComponentId b, bool own);
  /// The bounding spheres of all components.
  const BoundingSpheres& spheres() const { return surfaces_->spheres(); }

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
  struct Entry {
    CertificateFront front;
    bool b_moves = false;
    Pose fixed_pose;  ///< Of the fixed component in the last sweep.
  };

  static FrontKey key_of(ComponentId x, ComponentId y, GhostOf ghost);

  /// The ghosts that two components a < b have of their own, and use; else null.
  const AssemblySurfaces::SharedTree* ghosts_in_use(const PairKey& pair) const {
    return parted_.count(pair) > 0 ? nullptr : surfaces_->own_ghosts(pair);
  }

  std::shared_ptr<const AssemblySurfaces> surfaces_;
  std::set<PairKey> parted_;  ///< Pairs whose own ghosts are not in use.
  std::map<FrontKey, Entry> fronts_;
};

}  // namespace dismantle
