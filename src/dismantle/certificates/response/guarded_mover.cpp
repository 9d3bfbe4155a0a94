// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/response/guarded_mover.h"

#include "dismantle/engine/chords.h"

#include <algorithm>

namespace dismantle {

namespace {

/// A motion that the guard has shortened this many times is not made at all.
constexpr int kGuardTries = 4;

}  // namespace

GuardedMover::GuardedMover(CertificateSweeper& sweeper, const Assembly& assembly, const PairStates& pairs)
    : sweeper_(sweeper),
      guard_(
          assembly, pairs, [&sweeper](ComponentId c) -> const SolidTree& { return sweeper.solid(c); },
          sweeper.executor()),
      embedded_(assembly, pairs, sweeper.executor()),
      from_(assembly.components.size()),
      to_(assembly.components.size()),
      is_moving_(assembly.components.size()) {
  guard_.prepare();
}

void GuardedMover::set_near_component_pairs(std::vector<std::pair<ComponentId, ComponentId>> pairs) {
  for (const auto& [moving, fixed] : pairs) guard_.consider(moving, fixed, sweeper_.allowed(moving, fixed));
  near_component_pairs_ = std::move(pairs);
}

double GuardedMover::advance(const ScrewMotion& motion, double fraction, Shortening shortening) {
  const double made = fraction > 0 ? follow(motion, fraction, shortening) : 0;
  if (!(made > 0)) return 0;
  sweeper_.move_to(motion.at(made));
  adopt_parted();
  return made;
}

double GuardedMover::follow(const ScrewMotion& motion, double fraction, Shortening shortening) {
  blocking_vertices_.clear();
  fraction = guarded_fraction(motion, fraction, shortening);
  if (fraction <= 0) return 0;
  if (!embedded_.empty()) {
    for (std::size_t c = 0; c < is_moving_.size(); ++c)
      is_moving_[c] = sweeper_.moves(ComponentId(static_cast<std::uint32_t>(c)));
    const ScrewMotion allowed = sweeper_.motion_to(motion.at(fraction));
    const double made = embedded_.follow(is_moving_, sweeper_.poses(), allowed, kArcShare * sweeper_.tolerance());
    if (made < 1) {
      fraction *= made;
      fraction = fraction > 0 ? guarded_fraction(motion, fraction, shortening) : 0;
    }
  }
  if (fraction > 0 && !guard_.watches_nothing()) guard_.commit();
  return fraction;
}

double GuardedMover::guarded_fraction(const ScrewMotion& motion, double fraction, Shortening shortening) {
  if (guard_.watches_nothing()) return fraction;
  for (std::size_t c = 0; c < from_.size(); ++c) from_[c] = to_[c] = transform_from_pose(sweeper_.poses()[c]);
  for (int tries = 0; tries < kGuardTries; ++tries) {
    const RigidTransform next = transform_from_pose(motion.at(fraction));
    for (const ComponentId c : sweeper_.moving_set()) to_[c.value] = next;
    std::vector<BlockingPair> found = guard_.sweep(from_, to_, near_component_pairs_);
    if (found.empty()) return fraction;
    double toi = 1;
    for (const BlockingPair& c : found) toi = std::min(toi, c.toi);
    fraction *= toi * (1 - kBackoffShare);
    blocking_vertices_ = std::move(found);
    if (shortening == Shortening::None) break;
  }
  return 0;
}

void GuardedMover::adopt_parted() {
  for (const ComponentPair& pair : embedded_.take_parted()) sweeper_.part(pair.a, pair.b);
}

void GuardedMover::jump(Span<const Pose> poses) {
  sweeper_.jump(poses);
  guard_.jump();
  embedded_.jump(poses);
  adopt_parted();
}

}  // namespace dismantle
