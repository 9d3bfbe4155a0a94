// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/move_pairs.h"

namespace dismantle::audit {

namespace {

bool apart(const DepthPair& pair, const RigidTransform& a_from_b, double margin) {
  if (!surfaces_apart(pair.a->surface(), pair.b->surface(), a_from_b, margin)) return false;
  for (const std::uint32_t v : pair.b->surface().piece_vertices())
    if (pair.a->inside(a_from_b * pair.b->surface().vertex(v))) return false;
  const RigidTransform b_from_a = inverse(a_from_b);
  for (const std::uint32_t v : pair.a->surface().piece_vertices())
    if (pair.b->inside(b_from_a * pair.a->surface().vertex(v))) return false;
  return true;
}

/// True if both components are sheets, or have walls thinner than twice their allowance: what is near them may be on
/// either side, so that they have been apart only where they are further apart than the tolerance.
bool are_thin(const DepthContext& context, const MovePair& pair) {
  const double spacing = followed_spacing(*pair.pair.a, *pair.pair.b);
  const auto is_thin = [&](const SolidBody& body) {
    return !body.solid() || context.walls.has_thin_wall(body, 2 * pair.allowed, spacing);
  };
  return is_thin(*pair.pair.a) && is_thin(*pair.pair.b);
}

/// True if the sphere around b meets the box of a at some time; always for a pair that has still to come apart.
bool comes_near(const DepthContext& context, const MovePair& pair, const std::vector<MotionSegment>& segments) {
  const auto known = context.ledger.find(pair.key());
  if (known != context.ledger.end() && known->second.joined()) return true;
  const AuditBody& body_a = context.bodies[pair.a]->surface();
  const AuditBody& body_b = context.bodies[pair.b]->surface();
  const RigidTransform a_from_world = inverse(body_a.world_from_body(pair.pose_a));
  const BoxNode& box = body_a.node(0);
  for (const MotionSegment& segment : segments) {
    const Vec3 center = transform_from_pose(segment.start) * body_b.center();
    const Vec3 velocity =
        segment.screw.velocity + cross(segment.screw.angle * segment.screw.axis, center - segment.screw.reference);
    const Vec3 offset = a_from_world * center - box.center;
    const double distance = length(max(max(offset, -offset) - box.half, Vec3{}));
    if (distance <= (1 + 1e-9) * (body_b.node(0).reach + length(velocity)) + context.path.tolerance) return true;
  }
  return false;
}

}  // namespace

MovePairs find_move_pairs(const DepthContext& context, Span<const Pose> poses, std::size_t index) {
  MovePairs move;
  move.move = index;
  std::vector<Frame> frames = context.path.moves[index].frames;
  for (Frame& frame : frames) frame.pose.rotation = normalized(frame.pose.rotation);
  move.segments = motion_segments(frames);
  std::vector<bool> moves(context.bodies.size(), false);
  for (const std::string& name : context.path.moves[index].components)
    if (const auto id = context.assembly.find(name)) moves[id->value] = true;

  for (std::uint32_t b = 0; b < moves.size(); ++b) {
    if (!moves[b] || context.bodies[b]->surface().empty()) continue;
    for (std::uint32_t a = 0; a < moves.size(); ++a) {
      if (moves[a] || context.bodies[a]->surface().empty()) continue;
      MovePair pair;
      pair.a = a;
      pair.b = b;
      pair.pose_a = poses[a];
      pair.allowed = context.path.tolerance;
      const auto known = context.ledger.find(pair.key());
      if (known != context.ledger.end() && known->second.joined()) {
        pair.allowed = known->second.pair.allowed;
        pair.joined = true;
      }
      if (!comes_near(context, pair, move.segments)) continue;
      pair.pair = make_depth_pair(context, {a, b}, poses[a], move.segments);
      move.pairs.push_back(std::move(pair));
    }
  }
  std::sort(move.pairs.begin(), move.pairs.end(),
            [](const MovePair& p, const MovePair& q) { return p.key() < q.key(); });
  return move;
}

bool part_move_pairs(DepthContext& context, MovePairs& move, double progress_from, double progress_to) {
  const auto count = static_cast<std::uint32_t>(move.segments.size());
  const bool completed = context.run(move.pairs.size(), progress_from, progress_to, [&](std::size_t i) {
    MovePair& pair = move.pairs[i];
    pair.parted = count;
    if (!pair.joined) return;
    const bool turns = context.ledger.at(pair.key()).pair.turns;
    double margin = turns ? pair.allowed : context.slack;
    for (std::uint32_t k = 0; k < count && pair.parted == count; ++k) {
      const RigidTransform& at = pair.pair.motion.motions[k].start;
      if (!apart(pair.pair, at, margin)) continue;
      if (margin < context.path.tolerance && are_thin(context, pair)) {
        margin = context.path.tolerance;
        if (!apart(pair.pair, at, margin)) continue;
      }
      pair.parted = k;
    }
  });
  if (!completed) return false;
  for (const MovePair& pair : move.pairs)
    if (pair.parted < count) context.ledger.at(pair.key()).pair.parted = true;
  return true;
}

LedgerEntry& enter_violation(DepthContext& context, const MovePairs& move, const MovePair& pair,
                             const AuditViolation& violation) {
  LedgerEntry& entry = context.ledger[pair.key()];
  if (entry.violated) return entry;
  entry.violated = true;
  entry.violation = violation;
  entry.violation.a = ComponentId(pair.key().first);
  entry.violation.b = ComponentId(pair.key().second);
  entry.violation.move = move.move;
  return entry;
}

}  // namespace dismantle::audit
