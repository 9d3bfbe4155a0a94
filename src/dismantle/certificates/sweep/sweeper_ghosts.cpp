// SPDX-License-Identifier: Apache-2.0
// The ghost surfaces of pairs of components that touch or overlap in the assembled state, and their allowances.
#include "dismantle/certificates/ghosts/find_guards.h"
#include "dismantle/certificates/sweep/certificate_sweeper.h"

#include <utility>

namespace dismantle {

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
  static constexpr SurfacePair kBoth[] = {SurfacePair::MovingGhost, SurfacePair::FixedGhost};
  return Span<const SurfacePair>(kBoth, guarded(a, b).guard == PairGuard::Ghosts ? 2 : 0);
}

void CertificateSweeper::set_parted(ComponentId a, ComponentId b, bool parted) {
  const auto found = guarded_.find(std::minmax(a, b));
  if (found == guarded_.end()) return;
  found->second.parted = parted;
  store_.use_own_ghosts(a, b, !parted);
}

}  // namespace dismantle
