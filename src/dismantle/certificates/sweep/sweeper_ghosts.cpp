// SPDX-License-Identifier: Apache-2.0
// The ghost surfaces of pairs of components that touch or overlap in the assembled state, and their allowances.
#include "dismantle/certificates/ghosts/find_guards.h"
#include "dismantle/certificates/sweep/certificate_sweeper.h"

#include <utility>

namespace dismantle {

namespace {

Span<const SurfacePair> surface_pairs_of(const GuardedPair& pair) {
  static constexpr SurfacePair kBoth[] = {SurfacePair::MovingGhost, SurfacePair::FixedGhost};
  static constexpr SurfacePair kMirrored[] = {SurfacePair::MovingMirrored, SurfacePair::FixedMirrored};
  return {pair.sides.mirrored ? kMirrored : kBoth, std::size_t{pair.guard == PairGuard::Ghosts ? 2u : 0u}};
}

/// The first one of two components in the frame of the second one [assembled].
RigidTransform first_as_seen(bool first_moves, const Pose& moving, const Pose& fixed) {
  const RigidTransform of_moving = transform_from_pose(moving), of_fixed = transform_from_pose(fixed);
  return first_moves ? inverse(of_fixed) * of_moving : inverse(of_moving) * of_fixed;
}

}  // namespace

GuardedPair CertificateSweeper::guarded(ComponentId a, ComponentId b) const {
  const auto found = guarded_.find(std::minmax(a, b));
  if (found != guarded_.end() && !found->second.parted) return found->second;
  GuardedPair usual{PairGuard::Ghosts, tolerance_, {}, {}, kGhostLength * tolerance_};
  usual.parted = found != guarded_.end();
  return usual;
}

std::vector<ComponentPair> CertificateSweeper::overlapping_pairs() const {
  std::vector<ComponentPair> list;
  for (const auto& [key, pair] : guarded_) {
    if (pair.parted) continue;
    const PairState state = pair.guard == PairGuard::None ? PairState::Free : PairState::Overlapping;
    list.push_back({key.first, key.second, state, 0, 0, pair.allowed});
  }
  return list;
}

Span<const SurfacePair> CertificateSweeper::surface_pairs(ComponentId a, ComponentId b) const {
  return surface_pairs_of(guarded(a, b));
}

Span<const SurfacePair> CertificateSweeper::surface_pairs(ComponentId moving, ComponentId fixed, const Pose& start,
                                                          const Pose& end, const Pose& pose_fixed) const {
  GuardedPair pair = guarded(moving, fixed);
  if (pair.sides.both)
    pair.sides.begin_motion(start == pose_fixed, first_as_seen(moving < fixed, end, pose_fixed), tolerance_);
  return surface_pairs_of(pair);
}

void CertificateSweeper::begin_step(const Pose& target) {
  depth_tests_left_ = options_.depth_tests > 0 ? options_.depth_tests : kUnlimited;
  node_pairs_left_ = options_.node_pairs > 0 ? options_.node_pairs : kUnlimited;
  for (const ComponentId moving : moving_)
    for (const ComponentId other : guarded_of_[moving.value]) {
      GuardedPair& guarded = guarded_.at(std::minmax(moving, other));
      const Pose& fixed = poses_[other.value];
      if (guarded.sides.both && !guarded.parted && !is_moving_[other.value])
        guarded.sides.begin_motion(pose() == fixed, first_as_seen(moving < other, target, fixed), tolerance_);
    }
}

void CertificateSweeper::set_parted(ComponentId a, ComponentId b, bool parted) {
  const auto found = guarded_.find(std::minmax(a, b));
  if (found == guarded_.end()) return;
  found->second.parted = parted;
  store_.use_own_ghosts(a, b, !parted);
}

}  // namespace dismantle
