// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/sweep/front_store.h"

#include <algorithm>

namespace dismantle {

const SolidTree& FrontStore::ghost(ComponentId c, ComponentId other) const {
  const AssemblySurfaces::SharedTree* own = ghosts_in_use(std::minmax(c, other));
  return own ? *own[c < other ? 0 : 1] : surfaces_->ghost(c);
}

void FrontStore::use_own_ghosts(ComponentId a, ComponentId b, bool own) {
  const PairKey pair = std::minmax(a, b);
  if (!surfaces_->own_ghosts(pair) || (parted_.count(pair) == 0) == own) return;
  if (own)
    parted_.erase(pair);
  else
    parted_.insert(pair);
  for (const GhostOf ghost : {GhostOf::First, GhostOf::Second, GhostOf::FirstMirrored, GhostOf::SecondMirrored})
    fronts_.erase({pair, ghost});
}

CertificateFront FrontStore::new_front(ComponentId a, ComponentId b, GhostOf ghost) const {
  const auto tree = [&](ComponentId c, ComponentId other, GhostOf own, GhostOf mirrored) -> const SolidTree& {
    if (ghost == mirrored) return mirrored_ghost(c, other);
    return ghost == own ? this->ghost(c, other) : solid(c);
  };
  const SolidTree& of_a = tree(a, b, GhostOf::First, GhostOf::FirstMirrored);
  const SolidTree& of_b = tree(b, a, GhostOf::Second, GhostOf::SecondMirrored);
  // Matches name the threads of the first component first, and belong to the surfaces that they were found in.
  Span<const ThreadMatch> threads;
  if (a < b)
    threads = ghosts_in_use({a, b}) ? surfaces_->own_threads({{a, b}, ghost}) : surfaces_->threads({{a, b}, ghost});
  return {of_a.tree, of_b.tree, of_a.revolution.get(), of_b.revolution.get(), threads};
}

FrontKey FrontStore::key_of(ComponentId x, ComponentId y, GhostOf ghost) {
  if (x < y) return {{x, y}, ghost};
  switch (ghost) {
    case GhostOf::None:
      break;
    case GhostOf::First:
      return {{y, x}, GhostOf::Second};
    case GhostOf::Second:
      return {{y, x}, GhostOf::First};
    case GhostOf::FirstMirrored:
      return {{y, x}, GhostOf::SecondMirrored};
    case GhostOf::SecondMirrored:
      return {{y, x}, GhostOf::FirstMirrored};
  }
  return {{y, x}, GhostOf::None};
}

CertificateFront& FrontStore::prepare(ComponentId moving, ComponentId fixed, GhostOf ghost, Span<const Pose> poses) {
  const FrontKey key = key_of(moving, fixed, ghost);
  auto found = fronts_.find(key);
  if (found == fronts_.end())
    found = fronts_.emplace(key, Entry{new_front(key.first.first, key.first.second, key.second), false, {}}).first;
  Entry& entry = found->second;
  const bool b_moves = moving > fixed;
  if (entry.b_moves != b_moves) {
    entry.front.exchange_roles();
    entry.b_moves = b_moves;
  } else if (!(entry.fixed_pose == poses[fixed.value])) {
    entry.front.forget();
  }
  entry.fixed_pose = poses[fixed.value];
  return entry.front;
}

const CertificateFront* FrontStore::find(ComponentId moving, ComponentId fixed, GhostOf ghost,
                                         const Pose& pose_fixed) const {
  const auto known = fronts_.find(key_of(moving, fixed, ghost));
  const bool usable =
      known != fronts_.end() && known->second.b_moves == (moving > fixed) && known->second.fixed_pose == pose_fixed;
  return usable ? &known->second.front : nullptr;
}

std::size_t FrontStore::size(const std::vector<bool>& is_moving) const {
  std::size_t size = 0;
  for (const auto& [key, entry] : fronts_)
    if (is_moving[key.first.first.value] != is_moving[key.first.second.value]) size += entry.front.size();
  return size;
}

}  // namespace dismantle
