// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/box_lanes.h"
#include "dismantle/certificates/front/certificate_part.h"
#include "dismantle/certificates/front/front_results.h"
#include "dismantle/certificates/front/paired_trees.h"
#include "dismantle/certificates/front/triangle_lanes.h"
#include "dismantle/certificates/sweep/triangle_pair_sweep_kernel.h"
#include "dismantle/exec/append_buffer.h"

#include <cstring>

/// The kernels of DeviceFronts. All counts are in the device's memory, so that a sweep is enqueued without knowing
/// them.
namespace dismantle::device_front {

/// A page: one block of a part's certificates, and their pairs.
struct Page {
  float fields[CertificateBlocks::kFields * CertificateBlocks::kBlock];  ///< As CertificateBlocks has them.
  FrontPair pairs[CertificateBlocks::kBlock];                            ///< The last one repeated as padding.
};

/// New content of a page.
struct PageEdit {
  Page content;        ///< From the host.
  std::uint32_t page;  ///< Index of the page.
};

/// A page that a sweep checks.
struct CheckedPage {
  std::uint32_t page;   ///< Index of the page.
  std::uint32_t front;  ///< Index of the front in the query.
  std::uint32_t part;   ///< Index of the part, counted over all fronts.
  std::uint32_t begin;  ///< Slot of its first pair in the part.
  std::uint32_t count;  ///< Number of pairs in it.
};

/// A front of the query.
struct QueriedFront {
  LinearSweep sweep;                  ///< Its motion.
  PairedTrees trees;                  ///< Its trees, in the device's memory.
  std::uint32_t tests_triangles = 0;  ///< Not 0: triangles that are not separated are to be tested.
};

/// Size of a sweep.
struct SweepSize {
  std::uint32_t page_count = 0;  ///< Number of pages to be checked.
};

/// Counters of a sweep.
struct SweepCounters {
  std::uint64_t needed = 0;        ///< Pairs to be examined, including those that there was no room for.
  std::uint64_t begin = 0;         ///< First pair of this round.
  std::uint64_t end = 0;           ///< End of the pairs of this round.
  std::uint64_t tests_needed = 0;  ///< Triangle-pair tests to be made, including those that there was no room for.
  std::uint64_t tests_begin = 0;   ///< First test of this launch.
  std::uint64_t tests_end = 0;     ///< End of the tests of this launch.
};

/// A pair of nodes to be examined.
struct PendingPair {
  static constexpr std::uint32_t kDead = 0xffffffffu;  ///< Value of `a` of pairs that are not to be examined.

  std::uint32_t a = kDead;          ///< Node of A's tree.
  std::uint32_t b = kDead;          ///< Node of B's tree.
  std::uint32_t front = 0;          ///< Index of the front in the query.
  std::uint32_t are_triangles = 0;  ///< Not 0: the boxes need not be separated.
};

/// A triangle-pair test to be made.
struct TrianglePairRequest {
  std::uint32_t moving = 0;  ///< Face of the moving component.
  std::uint32_t fixed = 0;   ///< Face of the fixed component.
  std::uint32_t front = 0;   ///< Index of the front in the query.
  Vec3f hint;                ///< As TrianglePairCandidate::hint.
};

/// A gap as a word with the same order.
DISMANTLE_HOST_DEVICE inline std::uint64_t word_of_gap(float gap) {
  std::uint32_t word = 0;
  std::memcpy(&word, &gap, sizeof word);
  return (word & 0x80000000u) != 0 ? ~word : word | 0x80000000u;
}
/// The gap of a word from word_of_gap().
DISMANTLE_HOST_DEVICE inline float gap_of_word(std::uint64_t word) {
  const auto ordered = static_cast<std::uint32_t>(word);
  const std::uint32_t plain = (ordered & 0x80000000u) != 0 ? ordered & 0x7fffffffu : ~ordered;
  float gap = 0;
  std::memcpy(&gap, &plain, sizeof gap);
  return gap;
}

/// Copies edited pages to their indices. Item: a float of one.
struct EditPages {
  static constexpr std::size_t kItems = CertificateBlocks::kFields * CertificateBlocks::kBlock;  ///< Items of a page.
  Span<const PageEdit> edits;                                                                    ///< Input.
  Span<Page> pages;                                                                              ///< Output.

  /// Runs the item.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    const PageEdit& edit = edits[i / kItems];
    const std::size_t k = i % kItems;
    Page& page = pages[edit.page];
    page.fields[k] = edit.content.fields[k];
    if (k < CertificateBlocks::kBlock) page.pairs[k] = edit.content.pairs[k];
  }
};

/// Resets the counters and the smallest gaps. Item: a part.
struct BeginSweep {
  SweepCounters* counters;        ///< To be reset.
  Span<std::uint64_t> part_gaps;  ///< Of each part, as words.

  /// Runs the item.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    if (i == 0) *counters = {};
    part_gaps[i] = word_of_gap(CertificateCheck().min_gap);
  }
};

/// Append buffer of the pairs to be examined, with room for their results.
struct PairSink {
  Span<PendingPair> pairs;   ///< The pairs.
  Span<PairResult> results;  ///< Their results.
  std::uint64_t* needed;     ///< SweepCounters::needed.

  /// Reserves room for `count` pairs; if there is none, only counts them. All threads that reserve at one place in a
  /// kernel reserve the same number. @return index of the first; none for no room
  DISMANTLE_HOST_DEVICE std::uint32_t reserve(std::uint32_t count) const {
    const std::uint64_t first = atomic_count(needed, count);
    if (first + count <= pairs.size()) return static_cast<std::uint32_t>(first);
    for (std::uint64_t k = first; k < pairs.size(); ++k) put(static_cast<std::uint32_t>(k), {}, 0, PairResult::kNone);
    return PairResult::kNone;
  }
  /// Stores a pair at a reserved index. @param part, slot as PairResult has them
  DISMANTLE_HOST_DEVICE void put(std::uint32_t at, const PendingPair& pair, std::uint32_t part,
                                 std::uint32_t slot) const {
    pairs[at] = pair;
    results[at] = {PairResult::None, part, slot, PairResult::kNone, PairResult::kNone, {}};
  }
};

/// Append buffer of the triangle-pair tests to be made.
struct TestSink {
  Span<TrianglePairRequest> tests;  ///< The tests.
  std::uint64_t* needed;            ///< SweepCounters::tests_needed.

  /// Adds a test; if there is no room, only counts it. @return its index; none for no room
  DISMANTLE_HOST_DEVICE std::uint32_t append(const TrianglePairRequest& test) const {
    const std::uint64_t index = atomic_count(needed);
    if (index >= tests.size()) return PairResult::kNone;
    tests[index] = test;
    return static_cast<std::uint32_t>(index);
  }
};

/// Checks certificates against the sweep, and gathers the pairs whose own do not hold. Item: a slot in the pages to be
/// checked.
struct CheckCertificates {
  const SweepSize* size;            ///< Input.
  Span<const CheckedPage> checked;  ///< Input.
  Span<const Page> pages;           ///< Input.
  Span<const QueriedFront> fronts;  ///< Input.
  Span<std::uint64_t> part_gaps;    ///< Output: of each part, as words.
  PairSink sink;                    ///< Output: the pairs that do not hold.

  /// Runs the item.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    constexpr std::size_t kBlock = CertificateBlocks::kBlock;
    const std::size_t k = i % kBlock;
    if (i / kBlock >= size->page_count || k >= checked[i / kBlock].count) return;
    const CheckedPage& at = checked[i / kBlock];
    const Page& page = pages[at.page];
    const LinearSweep& sweep = fronts[at.front].sweep;
    const Lanes<1> gap = min_gaps<1>(CertificateBlocks{page.fields}, k, sweep);
    if (gap.r >= sweep.limit) {
      atomic_lower(&part_gaps[at.part], word_of_gap(gap.r));
      return;
    }
    const std::uint32_t index = sink.reserve(1);
    if (index != PairResult::kNone)
      sink.put(index, pending(at, page, k), at.part, at.begin + static_cast<std::uint32_t>(k));
  }

 private:
  DISMANTLE_HOST_DEVICE static PendingPair pending(const CheckedPage& at, const Page& page, std::size_t k) {
    const float kind = CertificateBlocks{page.fields}.certificate(k).hull.kind;
    PendingPair pair;
    // Pairs that were separated radially are left to the host: mostly they are again, without any other test.
    if (kind != NodeHull::kNone) pair.a = page.pairs[k].a;
    pair.b = page.pairs[k].b;
    pair.front = at.front;
    pair.are_triangles = kind > NodeHull::kBox ? 1 : 0;
    return pair;
  }
};

/// Advances to the pairs that were gathered so far. One item.
struct NextRound {
  SweepCounters* counters;  ///< To be advanced.
  std::uint64_t capacity;   ///< Of the pairs.

  /// Runs the item.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t) const {
    counters->begin = counters->end;
    counters->end = counters->needed < capacity ? counters->needed : capacity;
  }
};

/// Separates the pairs of a round, splits those that cannot be separated, and gathers the triangles to be tested. Item:
/// a pair of the round.
struct SeparatePairs {
  const SweepCounters* counters;    ///< Input.
  Span<const QueriedFront> fronts;  ///< Input.
  PairSink sink;                    ///< Pairs of the round, and output: their results, and what they are split into.
  TestSink tests;                   ///< Output: tests to be made.

  /// Runs the item.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    const std::size_t at = counters->begin + i;
    if (at >= counters->end || sink.pairs[at].a == PendingPair::kDead) return;
    const PendingPair pair = sink.pairs[at];
    const QueriedFront& front = fronts[pair.front];
    PairResult& result = sink.results[at];
    if (pair.are_triangles == 0) {
      const BoxPairQuery query = front.trees.box_query(pair.a, pair.b);
      separate_box_lanes<1>(&query, 1, front.sweep, &result.separation);
      if (result.separation.gap >= front.sweep.limit) {
        result.kind = PairResult::Boxes;
        return;
      }
      if (!front.trees.both_leaves(pair.a, pair.b)) {
        split(pair, front.trees, result);
        return;
      }
    }
    const TrianglePairQuery query = front.trees.triangle_query(pair.a, pair.b);
    separate_triangle_lanes<1>(&query, 1, front.sweep, &result.separation);
    result.kind = PairResult::Triangles;
    if (front.tests_triangles != 0 && result.separation.gap < front.sweep.limit)
      result.test = tests.append(request(pair, front.trees, result.separation));
  }

 private:
  /// With the same hint as in the front's own sweep.
  DISMANTLE_HOST_DEVICE static TrianglePairRequest request(const PendingPair& pair, const PairedTrees& trees,
                                                           const NodeSeparation& found) {
    const BoxPairQuery faces = trees.box_query(pair.a, pair.b);
    return {faces.a->child, faces.b->child, pair.front, found.certificate.axis};
  }
  DISMANTLE_HOST_DEVICE void split(const PendingPair& pair, const PairedTrees& trees, PairResult& result) const {
    result.kind = PairResult::Split;
    result.first_child = sink.reserve(2);
    if (result.first_child == PairResult::kNone) return;
    const bool splits_of_a = trees.splits_a(pair.a, pair.b);
    for (std::uint32_t k = 0; k < 2; ++k) {
      PendingPair half = pair;
      if (splits_of_a) {
        half.a = trees.a.nodes[pair.a].child + k;
      } else {
        half.b = trees.b.nodes[pair.b].child + k;
      }
      sink.put(result.first_child + k, half, result.part, PairResult::kNone);
    }
  }
};

/// Separates the boxes of pairs that siblings may merge into. Item: one of them.
struct SeparateCandidates {
  Span<const MergeCandidate> candidates;  ///< Input.
  Span<const QueriedFront> fronts;        ///< Input.
  Span<NodeSeparation> separations;       ///< Output: of each candidate.

  /// Runs the item.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    const MergeCandidate& pair = candidates[i];
    const QueriedFront& front = fronts[pair.front];
    const BoxPairQuery query = front.trees.box_query(pair.a, pair.b);
    separate_box_lanes<1>(&query, 1, front.sweep, &separations[i]);
  }
};

/// Advances to the tests that were gathered so far. One item.
struct NextTests {
  SweepCounters* counters;  ///< To be advanced.
  std::uint64_t capacity;   ///< Of the tests.

  /// Runs the item.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t) const {
    counters->tests_begin = counters->tests_end;
    counters->tests_end = counters->tests_needed < capacity ? counters->tests_needed : capacity;
  }
};

/// Tests pairs of triangles over the whole sweep. Item: one of the tests.
struct TestTrianglePairs {
  const SweepCounters* counters;                ///< Input.
  Span<const TrianglePairRequest> requests;     ///< Input.
  Span<const TrianglePairSweepKernel> kernels;  ///< Input: of each front of the query.
  Span<TrianglePairResult> results;             ///< Output: of each test.

  /// Runs the item.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    const std::size_t at = counters->tests_begin + i;
    if (at >= counters->tests_end) return;
    const TrianglePairRequest& request = requests[at];
    const Vec3f hint = request.hint;
    results[at] = kernels[request.front].test(request.moving, request.fixed, {hint.x, hint.y, hint.z}, 1);
  }
};

}  // namespace dismantle::device_front
