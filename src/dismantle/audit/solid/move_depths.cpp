// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/move_depths.h"

#include <algorithm>

namespace dismantle::audit {

namespace {

/// Factor by which the greatest depth that is reported of a pair that violates its allowance may be too low.
constexpr double kGrowth = 1.05;
/// Number of pieces after which the search for it gives up in a chunk.
constexpr std::size_t kMaxGreatestPieces = 20000;
/// Number of pieces after which the search turns to the other side of a pair, which may violate its allowance more
/// plainly: what a thin part passes through is deep in it soon, while the part itself is nowhere deep.
constexpr std::size_t kFirstPieces = 4096;
/// Factor by which this number grows from turn to turn.
constexpr std::size_t kMorePieces = 8;

/// A pair in one move.
struct MovePair {
  ///@{ The components; b moves.
  std::uint32_t a = 0, b = 0;
  ///@}
  DepthPair pair;
  double allowed = 0;        ///< Before it is apart [mm].
  std::uint32_t parted = 0;  ///< The first segment at whose start it has been apart.
  std::pair<std::uint32_t, std::uint32_t> key() const { return std::minmax(a, b); }
};

/// Consecutive segments of a pair that are searched together.
struct Chunk {
  std::size_t pair = 0;                ///< Index of the pair.
  std::uint32_t first = 0, count = 0;  ///< Its segments.
  double allowed = 0;                  ///< Allowance during them [mm].
  DepthFindings found[2];              ///< Points of a inside b, of b inside a.

  /// The violation of a search that ended at the first; its depth is 0 where there is none.
  const DepthSample& violation() const { return found[found[0].first.depth > 0 ? 0 : 1].first; }
};

bool apart(const DepthPair& pair, const RigidTransform& a_from_b, double margin) {
  if (!surfaces_apart(pair.a->surface(), pair.b->surface(), a_from_b, margin)) return false;
  for (const std::uint32_t v : pair.b->surface().piece_vertices())
    if (pair.a->inside(a_from_b * pair.b->surface().vertex(v))) return false;
  const RigidTransform b_from_a = inverse(a_from_b);
  for (const std::uint32_t v : pair.a->surface().piece_vertices())
    if (pair.b->inside(b_from_a * pair.a->surface().vertex(v))) return false;
  return true;
}

/// The check of one move: its segments, pairs and chunks.
class MoveDepths {
 public:
  MoveDepths(DepthContext& context, Span<const Pose> poses, std::size_t index)
      : context_(context), poses_(poses), index_(index) {
    std::vector<Frame> frames = context.path.moves[index].frames;
    for (Frame& frame : frames) frame.pose.rotation = normalized(frame.pose.rotation);
    segments_ = motion_segments(frames);
    moves_.resize(context.bodies.size(), false);
    for (const std::string& name : context.path.moves[index].components)
      if (const auto id = context.assembly.find(name)) moves_[id->value] = true;
  }

  bool run(double from, double to) {
    find_pairs();
    const double third = (to - from) / 3;
    return part_pairs(from, from + third / 2) && search(from + third / 2, from + 5 * third / 2) &&
           report(from + 5 * third / 2, to);
  }

 private:
  void find_pairs() {
    for (std::uint32_t b = 0; b < moves_.size(); ++b) {
      if (!moves_[b] || context_.bodies[b]->surface().empty()) continue;
      for (std::uint32_t a = 0; a < moves_.size(); ++a) {
        if (moves_[a] || context_.bodies[a]->surface().empty()) continue;
        MovePair pair;
        pair.a = a;
        pair.b = b;
        pair.allowed = context_.path.tolerance;
        const auto known = context_.ledger.find(pair.key());
        const bool overlaps = known != context_.ledger.end() && known->second.initial_depth > 0;
        if (overlaps && !known->second.parted) pair.allowed = known->second.allowed;
        if (!comes_near(a, b)) continue;
        pair.pair = make_depth_pair(context_, {a, b}, poses_[a], segments_);
        pairs_.push_back(std::move(pair));
      }
    }
    std::sort(pairs_.begin(), pairs_.end(), [](const MovePair& p, const MovePair& q) { return p.key() < q.key(); });
  }

  /// True if the sphere around b meets the box of a at some time; always for a pair that has still to come apart.
  bool comes_near(std::uint32_t a, std::uint32_t b) const {
    const auto known = context_.ledger.find(std::minmax(a, b));
    if (known != context_.ledger.end() && known->second.initial_depth > 0 && !known->second.parted) return true;
    const AuditBody& body_a = context_.bodies[a]->surface();
    const AuditBody& body_b = context_.bodies[b]->surface();
    const RigidTransform a_from_world = inverse(body_a.world_from_body(poses_[a]));
    const BoxNode& box = body_a.node(0);
    for (const MotionSegment& segment : segments_) {
      const Vec3 center = transform_from_pose(segment.start) * body_b.center();
      const Vec3 velocity =
          segment.screw.velocity + cross(segment.screw.angle * segment.screw.axis, center - segment.screw.reference);
      const Vec3 offset = a_from_world * center - box.center;
      const double distance = length(max(max(offset, -offset) - box.half, Vec3{}));
      if (distance <= (1 + 1e-9) * (body_b.node(0).reach + length(velocity)) + context_.path.tolerance) return true;
    }
    return false;
  }

  /// Finds the segments from which on pairs that overlapped have been apart.
  bool part_pairs(double from, double to) {
    const auto count = static_cast<std::uint32_t>(segments_.size());
    const bool completed = context_.run(pairs_.size(), from, to, [&](std::size_t i) {
      MovePair& pair = pairs_[i];
      pair.parted = count;
      if (pair.allowed == context_.path.tolerance) return;
      for (std::uint32_t k = 0; k < count && pair.parted == count; ++k)
        if (apart(pair.pair, pair.pair.sweep.motions[k].start, context_.slack)) pair.parted = k;
    });
    for (const MovePair& pair : pairs_)
      if (pair.parted < count) context_.ledger.at(pair.key()).parted = true;
    return completed;
  }

  void add_chunks(std::size_t i, std::uint32_t first, std::uint32_t end, double allowed) {
    for (; first < end; first += kSpanSegments) {
      Chunk chunk;
      chunk.pair = i;
      chunk.first = first;
      chunk.count = std::min(kSpanSegments, end - first);
      chunk.allowed = allowed;
      chunks_.push_back(chunk);
    }
  }

  DepthFindings search_chunk(const Chunk& chunk, bool of_b, const DepthGoal& goal) const {
    const MovePair& pair = pairs_[chunk.pair];
    const auto spans = motion_spans(segments_, chunk.first, chunk.count, pair.pair.b->surface());
    return search_depth(pair.pair, spans, of_b, goal);
  }

  /// Searches both sides of a chunk in turns, until one violates the allowance or both are done.
  void verify(Chunk& chunk) const {
    for (std::size_t pieces = kFirstPieces; chunk.violation().depth == 0; pieces *= kMorePieces) {
      for (int side = 0; side < 2 && chunk.violation().depth == 0; ++side) {
        if (chunk.found[side].complete) continue;
        const std::size_t before = chunk.found[side].samples;
        chunk.found[side] = search_chunk(chunk, side == 1, {chunk.allowed, context_.slack, 1, true, pieces});
        chunk.found[side].samples += before;
      }
      if (chunk.found[0].complete && chunk.found[1].complete) return;
    }
  }

  bool search(double from, double to) {
    const auto count = static_cast<std::uint32_t>(segments_.size());
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      add_chunks(i, 0, pairs_[i].parted, pairs_[i].allowed);
      add_chunks(i, pairs_[i].parted, count, context_.path.tolerance);
    }
    const bool completed = context_.run(chunks_.size(), from, to, [&](std::size_t i) { verify(chunks_[i]); });
    for (const Chunk& chunk : chunks_) context_.pieces += chunk.found[0].samples + chunk.found[1].samples;
    return completed;
  }

  /// The first segment of a chunk with a violation, alone.
  Chunk first_segment(const Chunk& chunk) const {
    Chunk one = chunk;
    one.count = 1;
    for (; one.first <= chunk.violation().segment; ++one.first) {
      for (DepthFindings& found : one.found) found = {};
      verify(one);
      if (one.violation().depth > 0) return one;
    }
    return chunk;
  }

  /// The greatest depth that is found of a pair in its chunks from `first` on.
  double greatest(std::size_t first, double depth) const {
    for (std::size_t i = first; i < chunks_.size() && chunks_[i].pair == chunks_[first].pair; ++i)
      for (const bool of_b : {false, true}) {
        const DepthGoal goal{kGrowth * depth, context_.slack, kGrowth, false, kMaxGreatestPieces};
        depth = std::max(depth, search_chunk(chunks_[i], of_b, goal).deepest.depth);
      }
    return depth;
  }

  bool report(double from, double to) {
    std::vector<std::size_t> first;  // chunk of each pair with its first violation in the move
    for (std::size_t i = 0; i < chunks_.size(); ++i)
      if (chunks_[i].violation().depth > 0 && (first.empty() || chunks_[first.back()].pair != chunks_[i].pair))
        first.push_back(i);
    std::vector<Chunk> found(first.size());
    std::vector<double> depth(first.size());
    const bool completed = context_.run(first.size(), from, to, [&](std::size_t i) {
      found[i] = first_segment(chunks_[first[i]]);
      depth[i] = greatest(first[i], found[i].violation().depth);
    });
    if (!completed) return false;
    for (std::size_t i = 0; i < first.size(); ++i) {
      DepthAuditPair& entry = context_.ledger[pairs_[found[i].pair].key()];
      if (!entry.violated) enter(found[i], entry);
      entry.violation.greatest = std::max(entry.violation.greatest, depth[i]);
    }
    return true;
  }

  /// Enters the first violation of a pair.
  void enter(const Chunk& chunk, DepthAuditPair& entry) const {
    const MovePair& pair = pairs_[chunk.pair];
    const DepthSample& sample = chunk.violation();
    const MotionSegment& segment = segments_[sample.segment];
    entry.a = ComponentId(pair.key().first);
    entry.b = ComponentId(pair.key().second);
    if (entry.allowed == 0) entry.allowed = context_.path.tolerance;
    entry.violated = true;
    DepthViolation& violation = entry.violation;
    violation.move = index_;
    violation.frame = segment.frame;
    violation.time = segment.time + sample.s * segment.duration;
    violation.depth = sample.depth;
    violation.allowed = chunk.allowed;
    violation.point = pair.pair.a->surface().world_from_body(poses_[pair.a]) * sample.point_a;
    violation.point_of_a = sample.of_b == (pair.b < pair.a);
  }

  DepthContext& context_;
  Span<const Pose> poses_;
  std::size_t index_;
  std::vector<MotionSegment> segments_;
  std::vector<bool> moves_;  // by component
  std::vector<MovePair> pairs_;
  std::vector<Chunk> chunks_;
};

}  // namespace

bool check_move_depths(DepthContext& context, Span<const Pose> poses, std::size_t index, double progress_from,
                       double progress_to) {
  return MoveDepths(context, poses, index).run(progress_from, progress_to);
}

}  // namespace dismantle::audit
