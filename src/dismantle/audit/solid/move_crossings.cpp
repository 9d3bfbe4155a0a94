// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/move_pairs.h"

namespace dismantle::audit {

namespace {

/// One side of a pair: points of one component in the frame of the other.
struct Side {
  std::size_t pair = 0;                            ///< Index of the pair.
  bool of_b = false;                               ///< Points of b in the frame of a, else of a in the frame of b.
  std::vector<FollowedPoint>* followed = nullptr;  ///< Of the context.
  Crossing crossing;                               ///< What was found.
};

AuditViolation violation_of(const MovePairs& move, const Side& side, double allowed) {
  const MovePair& pair = move.pairs[side.pair];
  const MotionSegment& segment = move.segments[side.crossing.segment];
  AuditViolation violation;
  violation.kind = AuditViolationKind::Crossing;
  violation.frame = segment.frame;
  violation.time = segment.time + side.crossing.s * segment.duration;
  violation.depth = side.crossing.beyond;
  violation.allowed = allowed;
  Vec3 point = side.crossing.point;
  if (!side.of_b) point = pair.pair.motion.motions[side.crossing.segment].at(side.crossing.s) * point;
  violation.point = pair.pair.a->surface().world_from_body(pair.pose_a) * point;
  violation.point_of_a = side.of_b == (pair.b < pair.a);
  violation.greatest = side.crossing.beyond;
  return violation;
}

/// The sides of the pairs that need the test, with the points that are followed from move to move.
std::vector<Side> find_sides(DepthContext& context, const MovePairs& move) {
  std::vector<Side> sides;
  for (std::size_t i = 0; i < move.pairs.size(); ++i) {
    const MovePair& pair = move.pairs[i];
    const auto known = context.ledger.find(pair.key());
    if (known != context.ledger.end() && known->second.violated) continue;
    if (!needs_crossing_test(*pair.pair.a, *pair.pair.b, context.path.tolerance)) continue;
    const double size = std::min(pair.pair.a->surface().node(0).radius, pair.pair.b->surface().node(0).radius);
    for (const bool of_b : {false, true}) {
      const std::uint32_t points = of_b ? pair.b : pair.a, surface = of_b ? pair.a : pair.b;
      const auto [entry, fresh] = context.followed.try_emplace({points, surface});
      if (fresh) entry->second = followed_points(context.bodies[points]->surface(), 2 * kFollowedSpacing * size);
      sides.push_back({i, of_b, &entry->second, {}});
    }
  }
  return sides;
}

}  // namespace

bool check_move_crossings(DepthContext& context, const MovePairs& move, double progress_from, double progress_to) {
  std::vector<Side> sides = find_sides(context, move);
  const bool completed = context.run(sides.size(), progress_from, progress_to, [&](std::size_t i) {
    Side& side = sides[i];
    const MovePair& pair = move.pairs[side.pair];
    std::vector<RelativeMotion> motions = pair.pair.motion.motions;
    if (!side.of_b) std::transform(motions.begin(), motions.end(), motions.begin(), reversed_roles);
    std::vector<double> allowed(motions.size(), pair.allowed);
    std::fill(allowed.begin() + std::min<std::ptrdiff_t>(pair.parted, std::ptrdiff_t(allowed.size())), allowed.end(),
              context.path.tolerance);
    const SolidBody& surface = side.of_b ? *pair.pair.a : *pair.pair.b;
    side.crossing =
        follow_points(surface.surface(), *side.followed, {motions, allowed, context.slack, pair.pair.motion.rounding});
  });
  for (const Side& side : sides) {
    if (side.crossing.beyond == 0) continue;
    const MovePair& pair = move.pairs[side.pair];
    const double allowed = side.crossing.segment < pair.parted ? pair.allowed : context.path.tolerance;
    enter_violation(context, move, pair, violation_of(move, side, allowed));
  }
  return completed;
}

}  // namespace dismantle::audit
