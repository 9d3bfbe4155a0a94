// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/helical_clearance.h"
#include "dismantle/audit/solid/move_pairs.h"

#include <algorithm>
#include <cmath>
#include <optional>

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

/// Consecutive segments of a pair that are searched together.
struct Chunk {
  std::size_t pair = 0;                ///< Index of the pair.
  std::uint32_t first = 0, count = 0;  ///< Its segments.
  double allowed = 0;                  ///< Allowance during them [mm].
  DepthFindings found[2];              ///< Points of a inside b, of b inside a.

  /// The violation of a search that ended at the first; its depth is 0 where there is none.
  const DepthSample& violation() const { return found[found[0].first.depth > 0 ? 0 : 1].first; }
};

/// The search for depths in one move.
class MoveDepths {
 public:
  MoveDepths(DepthContext& context, const MovePairs& move) : context_(context), move_(move) {}

  bool run(double from, double to) {
    const double most = from + 0.8 * (to - from);
    return search(from, most) && report(most, to);
  }

 private:
  void add_chunks(std::size_t i, std::uint32_t first, std::uint32_t end, double allowed) {
    if (std::isinf(allowed)) return;  // a free pair
    for (; first < end; first += kSpanSegments) {
      Chunk chunk;
      chunk.pair = i;
      chunk.first = first;
      chunk.count = std::min(kSpanSegments, end - first);
      chunk.allowed = allowed;
      chunks_.push_back(chunk);
    }
  }

  DepthFindings search_chunk(const Chunk& chunk, bool of_b, const DepthGoal& goal,
                             const std::vector<bool>& done = {}) const {
    const MovePair& pair = move_.pairs[chunk.pair];
    const auto spans = motion_spans(move_.segments, chunk.first, chunk.count, pair.pair.b->surface());
    return search_depth(pair.pair, spans, of_b, goal, done);
  }

  /// Searches both sides of a chunk in turns, until one violates the allowance or both are done.
  void verify(Chunk& chunk) const {
    std::optional<ClearFaces> clear;
    for (std::size_t pieces = kFirstPieces; chunk.violation().depth == 0; pieces *= kMorePieces) {
      for (int side = 0; side < 2 && chunk.violation().depth == 0; ++side) {
        if (chunk.found[side].complete) continue;
        const std::size_t before = chunk.found[side].samples;
        const std::vector<bool> none;
        chunk.found[side] = search_chunk(chunk, side == 1, {chunk.allowed, context_.slack, 1, true, pieces},
                                         !clear ? none : (side == 0 ? clear->of_a : clear->of_b));
        chunk.found[side].samples += before;
      }
      if (chunk.found[0].complete && chunk.found[1].complete) return;
      if (pieces == kFirstPieces && chunk.violation().depth == 0)
        clear = clear_in_helical_motion(move_.pairs[chunk.pair].pair, {chunk.first, chunk.count},
                                        chunk.allowed + context_.slack);
    }
  }

  bool search(double from, double to) {
    const auto count = static_cast<std::uint32_t>(move_.segments.size());
    for (std::size_t i = 0; i < move_.pairs.size(); ++i) {
      add_chunks(i, 0, move_.pairs[i].parted, move_.pairs[i].allowed);
      add_chunks(i, move_.pairs[i].parted, count, context_.path.tolerance);
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
      LedgerEntry& entry = enter_violation(context_, move_, move_.pairs[found[i].pair], violation_of(found[i]));
      entry.violation.greatest = std::max(entry.violation.greatest, depth[i]);
    }
    return true;
  }

  AuditViolation violation_of(const Chunk& chunk) const {
    const MovePair& pair = move_.pairs[chunk.pair];
    const DepthSample& sample = chunk.violation();
    const MotionSegment& segment = move_.segments[sample.segment];
    AuditViolation violation;
    violation.kind = AuditViolationKind::Depth;
    violation.frame = segment.frame;
    violation.time = segment.time + sample.s * segment.duration;
    violation.depth = sample.depth;
    violation.allowed = chunk.allowed;
    violation.point = pair.pair.a->surface().world_from_body(pair.pose_a) * sample.point_a;
    violation.point_of_a = sample.of_b == (pair.b < pair.a);
    return violation;
  }

  DepthContext& context_;
  const MovePairs& move_;
  std::vector<Chunk> chunks_;
};

}  // namespace

bool check_move_depths(DepthContext& context, Span<const Pose> poses, std::size_t index, double progress_from,
                       double progress_to) {
  MovePairs move = find_move_pairs(context, poses, index);
  const double part = (progress_to - progress_from) / 8;
  return part_move_pairs(context, move, progress_from, progress_from + part) &&
         MoveDepths(context, move).run(progress_from + part, progress_to - part) &&
         check_move_crossings(context, move, progress_to - part, progress_to);
}

}  // namespace dismantle::audit
