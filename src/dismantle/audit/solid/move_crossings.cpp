// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/move_pairs.h"

namespace dismantle::audit {

namespace {

/// Parts of a solid that are thinner than this part of the depth of a pair need not be found when its hole is cut out.
constexpr double kFinestCut = 0.25;

/// Points go through the surfaces of an overlapping pair where their ghosts are further away than so many times its
/// allowance: a ghost has to get round a corner that its point is deep in.
constexpr double kAroundCorners = 2;

/// One side of a pair: points of one component in the frame of the other.
struct Side {
  std::size_t pair = 0;              ///< Index of the pair.
  bool of_b = false;                 ///< Points of b in the frame of a, else of a in the frame of b.
  FollowedSide* followed = nullptr;  ///< Of the context.
  Crossing crossing;                 ///< What was found.
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

/// True if a pair overlaps in the assembled state and has not been apart, so that its allowance may be that of a wall.
bool is_joined(const DepthContext& context, const MovePair& pair) {
  return pair.joined && context.ledger.at(pair.key()).pair.state == PathPairState::Overlapping;
}

/// The points to follow on one side of a pair, and the hole for them; empty where its depth tells enough.
FollowedSide follow_side(DepthContext& context, const MovePair& pair, std::uint32_t points, std::uint32_t surface) {
  const SolidBody &body = *context.bodies[points], &other = *context.bodies[surface];
  const double spacing = followed_spacing(body, other), tolerance = context.path.tolerance;
  FollowedSide side;
  side.until_apart = !needs_crossing_test(body, other, tolerance);
  const bool joined = is_joined(context, pair);
  if (side.until_apart && !(joined && context.walls.has_thin_wall(other, 2 * pair.allowed, spacing))) return side;
  if (joined && body.solid() && other.solid()) {
    const double depth = context.ledger.at(pair.key()).pair.initial_depth;
    side.hole.emplace(other, body, pair.allowed, std::max(tolerance, kFinestCut * depth), context.walls);
  }
  side.points = followed_points(body.surface(), spacing);
  if (side.until_apart) {
    // Points that are near in the assembled state may leave to any side.
    const Vec3 there = body.surface().center() - other.surface().center();
    std::erase_if(side.points, [&](const FollowedPoint& point) {
      const Vec3 place = point.body + there;
      return other.surface().face_within(place, pair.allowed) || other.inside(place);
    });
  }
  return side;
}

/// A side of a pair, from which on points are followed.
struct NewSide {
  const MovePair* pair;
  std::uint32_t points, surface;
  FollowedSide* side;  ///< Of the context.
};

/// Finds what is followed of the pairs that need the test; false where it was cancelled.
bool begin_sides(DepthContext& context, const MovePairs& move, double progress) {
  std::vector<NewSide> fresh;
  for (const MovePair& pair : move.pairs) {
    if (!needs_crossing_test(*pair.pair.a, *pair.pair.b, context.path.tolerance) && !is_joined(context, pair)) continue;
    for (const auto& [points, surface] : {std::pair{pair.a, pair.b}, std::pair{pair.b, pair.a}}) {
      const auto [entry, is_fresh] = context.followed.try_emplace({points, surface});
      if (is_fresh) fresh.push_back({&pair, points, surface, &entry->second});
    }
  }
  return context.run(fresh.size(), progress, progress, [&](std::size_t i) {
    *fresh[i].side = follow_side(context, *fresh[i].pair, fresh[i].points, fresh[i].surface);
  });
}

/// The sides of the pairs of which points are followed.
std::vector<Side> find_sides(DepthContext& context, const MovePairs& move) {
  std::vector<Side> sides;
  for (std::size_t i = 0; i < move.pairs.size(); ++i) {
    const MovePair& pair = move.pairs[i];
    const auto known = context.ledger.find(pair.key());
    if (known != context.ledger.end() && known->second.violated) continue;
    for (const bool of_b : {false, true}) {
      const std::pair points_surface = of_b ? std::pair{pair.b, pair.a} : std::pair{pair.a, pair.b};
      const auto side = context.followed.find(points_surface);
      if (side == context.followed.end() || side->second.points.empty()) continue;
      if (side->second.until_apart && !pair.joined) continue;
      sides.push_back({i, of_b, &side->second, {}});
    }
  }
  return sides;
}

/// How far points of a side may be from their ghosts before the pair is apart [mm].
double allowed_of(const Side& side, const MovePair& pair) {
  return side.followed->hole && pair.joined ? kAroundCorners * pair.allowed : pair.allowed;
}

}  // namespace

bool check_move_crossings(DepthContext& context, const MovePairs& move, double progress_from, double progress_to) {
  if (!begin_sides(context, move, progress_from)) return false;
  std::vector<Side> sides = find_sides(context, move);
  const bool completed = context.run(sides.size(), progress_from, progress_to, [&](std::size_t i) {
    Side& side = sides[i];
    const MovePair& pair = move.pairs[side.pair];
    std::vector<RelativeMotion> motions = pair.pair.motion.motions;
    if (!side.of_b) std::transform(motions.begin(), motions.end(), motions.begin(), reversed_roles);
    std::vector<double> allowed(motions.size(), allowed_of(side, pair));
    std::fill(allowed.begin() + std::min<std::ptrdiff_t>(pair.parted, std::ptrdiff_t(allowed.size())), allowed.end(),
              context.path.tolerance);
    const SolidBody& surface = side.of_b ? *pair.pair.a : *pair.pair.b;
    const Hole* const hole = side.followed->hole && pair.joined ? &*side.followed->hole : nullptr;
    if (side.followed->until_apart) motions.resize(std::min<std::size_t>(pair.parted, motions.size()));
    side.crossing = follow_points(surface.surface(), side.followed->points,
                                  {motions, allowed, context.slack, pair.pair.motion.rounding, hole, pair.parted});
  });
  for (const Side& side : sides) {
    if (side.crossing.beyond == 0) continue;
    const MovePair& pair = move.pairs[side.pair];
    const double allowed = side.crossing.segment < pair.parted ? allowed_of(side, pair) : context.path.tolerance;
    enter_violation(context, move, pair, violation_of(move, side, allowed));
  }
  return completed;
}

}  // namespace dismantle::audit
