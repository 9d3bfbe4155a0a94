// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/box_lanes.h"
#include "dismantle/certificates/front/certificate_part.h"
#include "dismantle/certificates/front/front_results.h"
#include "dismantle/certificates/front/paired_trees.h"
#include "dismantle/certificates/front/triangle_lanes.h"
#include "dismantle/exec/append_buffer.h"

#include <cstring>

/// The bodies of a sweep of fronts that have copies on a device (DeviceFronts), with all counts in the device's
/// memory, so that a sweep is enqueued without knowing them.
namespace dismantle::device_front {

/// A page: one block of a part's certificates, and their pairs.
struct Page {
  float fields[CertificateBlocks::kFields * CertificateBlocks::kBlock];
  FrontPair pairs[CertificateBlocks::kBlock];
};

/// A page as the host has it now, for place `page`.
struct PageEdit {
  Page content;
  std::uint32_t page;
};

/// One page that a sweep checks.
struct CheckedPage {
  std::uint32_t page;   ///< Its place.
  std::uint32_t front;  ///< Of the fronts asked.
  std::uint32_t part;   ///< Of all parts asked.
  std::uint32_t begin;  ///< Place of its first pair in the part.
  std::uint32_t count;  ///< Pairs in it.
};

/// A front that is asked.
struct FrontOrder {
  LinearSweep sweep;
  PairedTrees trees;               ///< Those in the device's memory.
  std::uint32_t tests_leaves = 0;  ///< Not 0: triangles that are not apart are to be tested.
};

struct SweepOrder {
  std::uint32_t page_count = 0;
};

struct SweepCounters {
  std::uint64_t needed = 0;          ///< Pairs to be looked at, whether there was room for them or not.
  std::uint64_t begin = 0, end = 0;  ///< Those of this round.
  std::uint64_t leaves_needed = 0;   ///< The same of elementary tests.
  std::uint64_t leaves_begin = 0, leaves_end = 0;
};

/// A pair to be looked at.
struct AskedPair {
  static constexpr std::uint32_t kDead = 0xffffffffu;

  std::uint32_t a = kDead, b = kDead;  ///< Dead where there was room for one of two.
  std::uint32_t front = 0;
  std::uint32_t of_triangles = 0;  ///< Not 0: boxes need not be tried.
  std::uint32_t on_edge = 0;       ///< Not 0: the triangles were found to be in each other on edge.
  Vec3f hint;
};

/// Two faces to be tested.
struct TrianglePairRequest {
  std::uint32_t moving = 0, fixed = 0;
  std::uint32_t front = 0;
  Vec3f hint;
};

/// A gap as a word, in the same order.
DISMANTLE_HOST_DEVICE inline std::uint64_t word_of_gap(float gap) {
  std::uint32_t word = 0;
  std::memcpy(&word, &gap, sizeof word);
  return (word & 0x80000000u) != 0 ? ~word : word | 0x80000000u;
}
DISMANTLE_HOST_DEVICE inline float gap_of_word(std::uint64_t word) {
  const auto ordered = static_cast<std::uint32_t>(word);
  const std::uint32_t plain = (ordered & 0x80000000u) != 0 ? ordered & 0x7fffffffu : ~ordered;
  float gap = 0;
  std::memcpy(&gap, &plain, sizeof gap);
  return gap;
}

/// Puts edited pages where they belong. Item: a float of one.
struct EditPages {
  static constexpr std::size_t kItems = CertificateBlocks::kFields * CertificateBlocks::kBlock;
  Span<const PageEdit> edits;
  Span<Page> pages;

  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    const PageEdit& edit = edits[i / kItems];
    const std::size_t k = i % kItems;
    Page& page = pages[edit.page];
    page.fields[k] = edit.content.fields[k];
    if (k < CertificateBlocks::kBlock) page.pairs[k] = edit.content.pairs[k];
  }
};

/// Clears the counts and what is least. Item: a part.
struct BeginSweep {
  SweepCounters* counters;
  Span<std::uint64_t> least;

  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    if (i == 0) *counters = {};
    least[i] = word_of_gap(CertificateCheck().min_gap);
  }
};

/// Pairs to be looked at, and room for what is found of them.
struct PairSink {
  Span<AskedPair> pairs;
  Span<PairResult> answers;
  std::uint64_t* needed;

  /// Room for so many; where there is none they are counted only. @return the first place; none for no room
  DISMANTLE_HOST_DEVICE std::uint32_t take(std::uint32_t count) const {
    const std::uint64_t place = atomic_add(needed, count);
    if (place + count <= pairs.size()) return static_cast<std::uint32_t>(place);
    for (std::uint64_t k = place; k < pairs.size(); ++k) put(static_cast<std::uint32_t>(k), {}, 0, PairResult::kNone);
    return PairResult::kNone;
  }
  DISMANTLE_HOST_DEVICE void put(std::uint32_t at, const AskedPair& pair, std::uint32_t part,
                                 std::uint32_t place) const {
    pairs[at] = pair;
    answers[at] = {PairResult::None, part, place, PairResult::kNone, PairResult::kNone, {}};
  }
};

/// Faces to be tested.
struct LeafSink {
  Span<TrianglePairRequest> leaves;
  std::uint64_t* needed;

  /// Where there is no room it is counted only. @return its place; none for no room
  DISMANTLE_HOST_DEVICE std::uint32_t append(const TrianglePairRequest& leaf) const {
    const std::uint64_t place = atomic_add(needed, 1);
    if (place >= leaves.size()) return PairResult::kNone;
    leaves[place] = leaf;
    return static_cast<std::uint32_t>(place);
  }
};

/// Certificates against the sweep. Item: a place in the pages that are checked.
struct CheckCertificates {
  const SweepOrder* order;
  Span<const CheckedPage> checked;
  Span<const Page> pages;
  Span<const FrontOrder> fronts;
  Span<std::uint64_t> least;
  PairSink sink;

  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    constexpr std::size_t kBlock = CertificateBlocks::kBlock;
    const std::size_t k = i % kBlock;
    if (i / kBlock >= order->page_count || k >= checked[i / kBlock].count) return;
    const CheckedPage& at = checked[i / kBlock];
    const Page& page = pages[at.page];
    const LinearSweep& sweep = fronts[at.front].sweep;
    Lanes<1> kind;
    const Lanes<1> gap = min_gaps<1>(CertificateBlocks{page.fields}, k, sweep, kind);
    if (any(certify<1>(gap, kind, sweep))) {
      atomic_lower(&least[at.part], word_of_gap(gap.r));
      return;
    }
    const std::uint32_t place = sink.take(1);
    if (place != PairResult::kNone)
      sink.put(place, asked(at, page, k), at.part, at.begin + static_cast<std::uint32_t>(k));
  }

 private:
  DISMANTLE_HOST_DEVICE AskedPair asked(const CheckedPage& at, const Page& page, std::size_t k) const {
    const FrontOrder& front = fronts[at.front];
    const Certificate certificate = CertificateBlocks{page.fields}.certificate(k);
    const float kind = certificate.hull.kind;
    AskedPair pair;
    // What was parted as round the host looks at: mostly it is so again, and nothing else is to be known of it.
    if (kind != NodeHull::kNone) pair.a = page.pairs[k].a;
    pair.b = page.pairs[k].b;
    pair.front = at.front;
    pair.of_triangles = kind > NodeHull::kBox ? 1 : 0;
    pair.on_edge = kind == NodeHull::kTriangleOnEdge ? 1 : 0;
    pair.hint = front.trees.hint_of(certificate, front.sweep);
    return pair;
  }
};

/// Goes on to what was found by now. One item.
struct NextRound {
  SweepCounters* counters;
  std::uint64_t capacity;

  DISMANTLE_HOST_DEVICE void operator()(std::size_t) const {
    counters->begin = counters->end;
    counters->end = counters->needed < capacity ? counters->needed : capacity;
  }
};

/// Separates the pairs of a round, splits what cannot be separated, and gathers the faces that are to be tested. Item:
/// a place in the round.
struct SeparatePairs {
  const SweepCounters* counters;
  Span<const FrontOrder> fronts;
  PairSink sink;
  LeafSink leaves;

  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    const std::size_t at = counters->begin + i;
    if (at >= counters->end || sink.pairs[at].a == AskedPair::kDead) return;
    const AskedPair pair = sink.pairs[at];
    const FrontOrder& front = fronts[pair.front];
    PairResult& answer = sink.answers[at];
    if (pair.of_triangles == 0) {
      const BoxPairQuery query = front.trees.box_query(pair.a, pair.b, pair.hint);
      separate_box_lanes<1>(&query, 1, front.sweep, &answer.separation);
      if (front.trees.certifies(answer.separation, pair.hint, false, front.sweep)) {
        answer.kind = PairResult::Boxes;
        return;
      }
      if (!front.trees.leaves(pair.a, pair.b)) {
        split(pair, front.trees, answer);
        return;
      }
    }
    const TrianglePairQuery query = front.trees.triangle_query(pair.a, pair.b, pair.hint);
    separate_triangle_lanes<1>(&query, 1, front.sweep, &answer.separation);
    answer.kind = PairResult::Triangles;
    if (front.tests_leaves != 0 && !front.trees.certifies(answer.separation, pair.hint, pair.on_edge != 0, front.sweep))
      answer.leaf = leaves.append(asked(pair, front.trees, answer.separation));
  }

 private:
  /// With the hint that the front's own sweep has.
  DISMANTLE_HOST_DEVICE static TrianglePairRequest asked(const AskedPair& pair, const PairedTrees& trees,
                                                         const NodeSeparation& found) {
    const BoxPairQuery faces = trees.box_query(pair.a, pair.b, {});
    return {faces.a->child, faces.b->child, pair.front, trees.leaf_hint(pair.hint, found)};
  }
  DISMANTLE_HOST_DEVICE void split(const AskedPair& pair, const PairedTrees& trees, PairResult& answer) const {
    answer.kind = PairResult::Split;
    answer.first_child = sink.take(2);
    if (answer.first_child == PairResult::kNone) return;
    const bool splits_of_a = trees.splits_a(pair.a, pair.b);
    for (std::uint32_t k = 0; k < 2; ++k) {
      AskedPair half = pair;
      if (splits_of_a) {
        half.a = trees.a.nodes[pair.a].child + k;
      } else {
        half.b = trees.b.nodes[pair.b].child + k;
      }
      sink.put(answer.first_child + k, half, answer.part, PairResult::kNone);
    }
  }
};

/// Separates the boxes of pairs that siblings may merge into. Item: one of them.
struct SeparateParents {
  Span<const MergeCandidate> asked;
  Span<const FrontOrder> fronts;
  Span<NodeSeparation> found;

  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    const MergeCandidate& pair = asked[i];
    const FrontOrder& front = fronts[pair.front];
    const BoxPairQuery query = front.trees.box_query(pair.a, pair.b, pair.hint);
    separate_box_lanes<1>(&query, 1, front.sweep, &found[i]);
  }
};

/// Goes on to the tests that were gathered by now. One item.
struct NextLeaves {
  SweepCounters* counters;
  std::uint64_t capacity;

  DISMANTLE_HOST_DEVICE void operator()(std::size_t) const {
    counters->leaves_begin = counters->leaves_end;
    counters->leaves_end = counters->leaves_needed < capacity ? counters->leaves_needed : capacity;
  }
};

/// Tests faces for the whole motion. Item: a place among the tests.
/// @tparam Kernel has test(moving, fixed, hint, horizon)
template <class Kernel, class Found>
struct TestLeaves {
  const SweepCounters* counters;
  Span<const TrianglePairRequest> asked;
  Span<const Kernel> kernels;  ///< Of each front asked.
  Span<Found> found;

  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    const std::size_t at = counters->leaves_begin + i;
    if (at >= counters->leaves_end) return;
    const TrianglePairRequest& leaf = asked[at];
    found[at] = kernels[leaf.front].test(leaf.moving, leaf.fixed, {leaf.hint.x, leaf.hint.y, leaf.hint.z}, 1);
  }
};

}  // namespace dismantle::device_front
