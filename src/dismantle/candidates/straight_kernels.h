// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/candidates/candidate_kernel.h"
#include "dismantle/exec/append_buffer.h"

/// The first contacts of many translations from one state, in the order of these kernels: the near pair of each that
/// may meet first is found (FindSoonest) and tested (TestSoonest); in rounds, some near pairs that may still meet
/// before the first contact so far are listed, tested and compared (ListEarlier, TestEarlier, TakeEarliest); then comes
/// what is far (SweepFar). So the threads of a warp test together and look for pairs together. A candidate's rounds do
/// not depend on the other candidates.
namespace dismantle {

/// Keys that sort translations by their directions. Item: a candidate.
struct KeyDirections {
  static constexpr int kBits = 24;  ///< Low bits of a key: a cell of directions; above them the candidate's number.

  Span<const Vec3> displacements;  ///< Of each candidate [mm, world].
  Span<std::uint64_t> keys;        ///< Output, one for each candidate.

  /// Candidate i.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    keys[i] = static_cast<std::uint64_t>(i) << kBits | cell_of(displacements[i]);
  }

 private:
  /// The cell of a direction on an octahedron that is unfolded to a square, in Morton order.
  DISMANTLE_HOST_DEVICE static std::uint64_t cell_of(Vec3 d) {
    const Vec3 size = absolute(d);
    const double sum = size.x + size.y + size.z;
    if (!(sum > 0)) return 0;
    double x = d.x / sum, y = d.y / sum;
    if (d.z < 0) {
      const double folded = (1 - size.y / sum) * (x < 0 ? -1 : 1);
      y = (1 - size.x / sum) * (y < 0 ? -1 : 1);
      x = folded;
    }
    return spread(x) | spread(y) << 1;
  }
  /// A coordinate in [-1, 1] as an integer, with a 0 above each of its bits.
  DISMANTLE_HOST_DEVICE static std::uint64_t spread(double x) {
    constexpr int kHalf = 1 << (kBits / 2 - 1);
    const double scaled = (x + 1) * kHalf;
    std::uint64_t bits = scaled < 2 * kHalf ? static_cast<std::uint64_t>(scaled) : 2 * kHalf - 1;
    bits = (bits | bits << 8) & 0x00ff00ff;
    bits = (bits | bits << 4) & 0x0f0f0f0f;
    bits = (bits | bits << 2) & 0x33333333;
    return (bits | bits << 1) & 0x55555555;
  }
};

/// Translations from one state.
struct StraightBatch {
  CandidateScene scene;              ///< The state.
  NearLists lists;                   ///< Of the state.
  Span<const Vec3> displacements;    ///< Of each candidate [mm, world].
  Span<const std::uint64_t> sorted;  ///< Keys of KeyDirections: threads of a warp look at nearly the same pairs.

  /// The candidate of key i.
  DISMANTLE_HOST_DEVICE std::uint32_t candidate(std::size_t i) const {
    return static_cast<std::uint32_t>(sorted[i] >> KeyDirections::kBits);
  }
  /// The contact of two leaves in a candidate's motion, if it is before a known one; otherwise that.
  DISMANTLE_HOST_DEVICE CandidateContact contact(std::uint32_t candidate, NodePair leaves,
                                                 const CandidateContact& known) const {
    const StraightPiece piece(scene, displacements[candidate]);
    return CandidateSearch<StraightPiece>(scene, piece, known).first_of(leaves);
  }
};

/// The near pairs that may meet first.
struct SoonestPairs {
  static constexpr int kCount = 4;  ///< Where the first does not meet, another one near it does.

  std::uint32_t near[kCount];  ///< Their numbers in the list, the one of the highest rate first; then kNone.
  double rate;                 ///< No pair has a higher one.

  static constexpr std::uint32_t kNone = ~std::uint32_t{0};  ///< No pair.

  /// True if a pair is one of them.
  DISMANTLE_HOST_DEVICE bool has(std::uint32_t pair) const {
    bool found = false;
    for (const std::uint32_t k : near) found = found || k == pair;
    return found;
  }
};

/// The rate that a pair must exceed to meet within a share `toi` of a motion; a little less, for rounding.
DISMANTLE_HOST_DEVICE inline double least_rate(double toi) {
  return (1 - 1e-12) / toi;
}

/// Item: a key.
struct FindSoonest {
  StraightBatch batch;         ///< The translations.
  Span<SoonestPairs> soonest;  ///< Output, one for each candidate.

  /// The candidate of key i.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    const std::uint32_t candidate = batch.candidate(i);
    const StraightMotion motion(batch.displacements[candidate]);
    const Span<const NearLeaves> near = batch.lists.near;
    SoonestPairs first{{}, least_rate(1)};
    double rates[SoonestPairs::kCount];
    for (int k = 0; k < SoonestPairs::kCount; ++k) {
      first.near[k] = SoonestPairs::kNone;
      rates[k] = least_rate(1);
    }
    for (std::uint32_t k = 0; k < near.size() && near[k].gap * first.rate <= motion.distance; ++k) {
      const double rate = batch.lists.closing_rate(k, motion, rates[SoonestPairs::kCount - 1]);
      if (!(rate > rates[SoonestPairs::kCount - 1])) continue;
      int at = SoonestPairs::kCount - 1;
      for (; at > 0 && rate > rates[at - 1]; --at) {
        rates[at] = rates[at - 1];
        first.near[at] = first.near[at - 1];
      }
      rates[at] = rate;
      first.near[at] = k;
      first.rate = rates[0];
    }
    soonest[candidate] = first;
  }
};

/// Item: a key.
struct TestSoonest {
  StraightBatch batch;                  ///< The translations.
  Span<const SoonestPairs> soonest;     ///< Of each candidate.
  Span<CandidateContact> found;         ///< Output: the first contact of these pairs, one for each candidate.
  Span<std::uint32_t> next;             ///< Output: 0, one for each candidate.
  AppendView<std::uint32_t> undecided;  ///< Output: candidates that other near pairs may stop before.

  /// The candidate of key i.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    const std::uint32_t candidate = batch.candidate(i);
    const SoonestPairs& pairs = soonest[candidate];
    const StraightMotion motion(batch.displacements[candidate]);
    CandidateContact contact;
    for (const std::uint32_t k : pairs.near)
      if (k != SoonestPairs::kNone &&
          batch.lists.closing_rate(k, motion, least_rate(contact.toi)) > least_rate(contact.toi))
        contact = batch.contact(candidate, batch.lists.near[k].leaves, contact);
    found[candidate] = contact;
    next[candidate] = 0;
    if (pairs.rate > least_rate(contact.toi)) undecided.append_together(candidate);
  }
};

/// A near pair that may stop a candidate before its first contact so far.
struct EarlierPair {
  std::uint32_t candidate;   ///< The candidate.
  std::uint32_t near;        ///< The pair's number in the list.
  CandidateContact contact;  ///< Its contact, or the first so far.
};

/// Lists pairs in the order of the near list. Item: an undecided candidate.
struct ListEarlier {
  StraightBatch batch;                   ///< The translations.
  Span<const std::uint32_t> undecided;   ///< Candidates.
  Span<const SoonestPairs> soonest;      ///< Of each candidate.
  Span<const CandidateContact> found;    ///< Of each candidate: the first contact so far.
  std::uint32_t each;                    ///< Pairs that are listed for a candidate at most.
  Span<std::uint32_t> next;              ///< Of each candidate: the near pair to begin with, and output: to go on with.
  Span<EarlierPair> pairs;               ///< Output, shape [undecided][each].
  Span<std::uint32_t> counts;            ///< Output: how many there are, shape [undecided].
  AppendView<std::uint32_t> unfinished;  ///< Output: candidates that may have more pairs.

  /// Undecided candidate i.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    const std::uint32_t candidate = undecided[i];
    const StraightMotion motion(batch.displacements[candidate]);
    const SoonestPairs tested = soonest[candidate];
    const CandidateContact known = found[candidate];
    const double reach = known.toi * motion.distance, least = least_rate(known.toi);
    const Span<const NearLeaves> near = batch.lists.near;
    std::uint32_t count = 0, k = next[candidate];
    for (; count < each && k < near.size() && near[k].gap <= reach; ++k)
      if (batch.lists.closing_rate(k, motion, least) > least && !tested.has(k))
        pairs[i * each + count++] = {candidate, k, known};
    next[candidate] = k;
    counts[i] = count;
    if (count == each) unfinished.append_together(candidate);
  }
};

/// Item: room for a listed pair.
struct TestEarlier {
  StraightBatch batch;               ///< The translations.
  std::uint32_t each;                ///< As of ListEarlier.
  Span<const std::uint32_t> counts;  ///< Shape [undecided].
  Span<EarlierPair> pairs;           ///< Their contacts are set, shape [undecided][each].

  /// Pair i % each of undecided candidate i / each.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    if (i % each >= counts[i / each]) return;
    EarlierPair& pair = pairs[i];
    pair.contact = batch.contact(pair.candidate, batch.lists.near[pair.near].leaves, pair.contact);
  }
};

/// Item: an undecided candidate.
struct TakeEarliest {
  Span<const std::uint32_t> undecided;  ///< Candidates.
  std::uint32_t each;                   ///< As of ListEarlier.
  Span<const std::uint32_t> counts;     ///< Shape [undecided].
  Span<const EarlierPair> pairs;        ///< All that were listed, shape [undecided][each].
  Span<CandidateContact> found;         ///< Of each candidate: the first contact so far.

  /// Undecided candidate i.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    CandidateContact earliest = found[undecided[i]];
    for (std::uint32_t k = 0; k < counts[i]; ++k) {
      const CandidateContact& contact = pairs[i * each + k].contact;
      if (contact.toi < earliest.toi) earliest = contact;
    }
    found[undecided[i]] = earliest;
  }
};

/// Item: a key.
struct SweepFar {
  StraightBatch batch;           ///< The translations.
  Span<CandidateContact> found;  ///< Of each candidate: that of near pairs, and output: of all.

  /// The candidate of key i.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    const std::uint32_t candidate = batch.candidate(i);
    const StraightMotion motion(batch.displacements[candidate]);
    const Span<const FarNodes> far = batch.lists.far;
    const CandidateContact known = found[candidate];
    if (far.empty() || far[0].gap > known.toi * motion.distance) return;
    const StraightPiece piece(batch.scene, batch.displacements[candidate]);
    found[candidate] = CandidateSearch<StraightPiece>(batch.scene, piece, known).first_of_far(batch.lists, motion);
  }
};

}  // namespace dismantle
