// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/certificate_front.h"
#include "dismantle/certificates/sweep/triangle_pair_sweep_kernel.h"

#include <utility>
#include <vector>

/// The working memory of a sweep of one part of a front: for the front's own sources.
namespace dismantle {

/// A sweep that may stop early takes at most this many blocked pairs below one pair of the front.
inline constexpr std::size_t kMaxBlockedOfPair = 2;

/// A pair of nodes that needs a new certificate.
struct CertificateFront::Item {
  static constexpr std::uint32_t kNone = 0xffffffffu;  ///< No index.
  std::uint32_t a = 0;                                 ///< Node of A's tree.
  std::uint32_t b = 0;                                 ///< Node of B's tree.
  std::uint32_t slot = kNone;                          ///< In the part; none for what is appended.
  std::uint32_t first_child = kNone;                   ///< Index of the first of two items that replace it.
  std::uint32_t proof = kNone;                         ///< Index of its certificate; none if it was not examined.
  std::uint32_t start = 0;                             ///< Index of the start that it descends from.
  std::uint32_t known = kNone;                         ///< Index of a device's result for it, if there is one.
  bool radial = false;                                 ///< The front's pair was separated radially the last time.
  bool are_triangles = false;                          ///< The front tested these two triangles before.
};

/// Everything that a sweep of one part works on.
struct CertificateFront::Work {
  bool keeps = true;                                ///< False: the front stays unchanged, and needs no certificates.
  std::vector<std::uint32_t> failing;               ///< Slots of the pairs whose certificates do not hold.
  std::vector<Item> items;                          ///< These pairs, in order, then their descendants.
  std::vector<std::uint32_t> done;                  ///< Indices of items to be used again, if nothing is kept.
  std::vector<Certificate> proofs;                  ///< Certificates found.
  std::size_t front_count = 0;                      ///< This many items are pairs of the front.
  std::vector<std::uint32_t> blocked;               ///< Blocked pairs of each start.
  std::vector<std::uint32_t> waiting;               ///< Indices of items, the next one last.
  std::vector<std::uint32_t> batch;                 ///< Items that are examined together.
  std::vector<std::uint32_t> box_items;             ///< Items of the batch to be separated as boxes.
  std::vector<BoxPairQuery> box_queries;            ///< Those that no device has separated.
  std::vector<std::uint32_t> triangle_items;        ///< Items to be separated as triangles.
  std::vector<TrianglePairQuery> triangle_queries;  ///< Those that no device has separated.
  std::vector<NodeSeparation> separations;          ///< Of the box or triangle items, in order.
  std::vector<NodeSeparation> computed;             ///< Of the queries.
  Span<const PairResult> known_pairs;               ///< Results of a device, if one was used.
  Span<const TrianglePairResult> known_tests;       ///< Its triangle-pair tests.

  /// Stores the certificate of an item, which is done.
  void prove(std::uint32_t i, const Certificate& certificate) {
    if (!keeps) {
      done.push_back(i);
      return;
    }
    items[i].proof = static_cast<std::uint32_t>(proofs.size());
    proofs.push_back(certificate);
  }
  /// Adds an item. @return its index
  std::uint32_t add(const Item& item) {
    if (done.empty()) {
      items.push_back(item);
      return static_cast<std::uint32_t>(items.size() - 1);
    }
    const std::uint32_t i = done.back();
    done.pop_back();
    items[i] = item;
    return i;
  }
  /// The stage that a device reached with the item.
  PairResult::Kind known_kind(const Item& item) const {
    return item.known == Item::kNone ? PairResult::None : known_pairs[item.known].kind;
  }
  /// A device's test of the item's triangles; null if it has none.
  const TrianglePairResult* known_test(const Item& item) const {
    const std::uint32_t test = item.known == Item::kNone ? PairResult::kNone : known_pairs[item.known].test;
    return test == PairResult::kNone ? nullptr : &known_tests[test];
  }
  /// Merges the computed separations with those that a device has found; items whose result is of another kind were
  /// found not to be separated.
  void merge_known(const std::vector<std::uint32_t>& all_items, PairResult::Kind kind) {
    if (computed.size() == all_items.size()) {
      separations.swap(computed);
      return;
    }
    separations.resize(all_items.size());
    std::size_t next = 0;
    for (std::size_t k = 0; k < all_items.size(); ++k) {
      const Item& item = items[all_items[k]];
      if (known_kind(item) == PairResult::None) {
        separations[k] = computed[next++];
      } else if (known_kind(item) == kind) {
        separations[k] = known_pairs[item.known].separation;
      } else {
        separations[k] = {-3e38f, Certificate::none()};
      }
    }
  }
};

}  // namespace dismantle
