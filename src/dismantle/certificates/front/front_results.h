// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/certificate_kernels.h"
#include "dismantle/core/span.h"

#include <cstdint>
#include <vector>

namespace dismantle {

class CertificateFront;
class TrianglePairSweep;
struct TrianglePairResult;

/// A front whose certificates a device evaluates for a sweep.
struct FrontQuery {
  CertificateFront* front;   ///< The front; the device marks as unchanged what it has copied.
  const LinearSweep* sweep;  ///< The sweep, made by CertificateFront::prepare_sweep().
  /// The triangle-pair tests of this sweep; null if the device is not to test triangles.
  const TrianglePairSweep* triangle_pairs = nullptr;
};

/// Device result for a pair of nodes whose certificate does not hold.
struct PairResult {
  /// The stage that the device reached with the pair.
  enum Kind : std::uint32_t {
    None,       ///< Not evaluated: left to the host.
    Boxes,      ///< `separation` certifies the pair as boxes.
    Split,      ///< Not separated as boxes; replaced by the halves of the larger node.
    Triangles,  ///< Not separated as boxes; `separation` is that of the two triangles.
  };
  static constexpr std::uint32_t kNone = 0xffffffffu;  ///< No index.

  Kind kind = None;                   ///< How far the device got.
  std::uint32_t part = 0;             ///< Index of the part, counted over all fronts of the query.
  std::uint32_t slot = kNone;         ///< Index of the pair in its part; none for what pairs were split into.
  std::uint32_t first_child = kNone;  ///< Index of the first of two results; none if there was no room for them.
  std::uint32_t test = kNone;         ///< Triangles: index in PartResults::tests; none if the two were not tested.
  NodeSeparation separation = {};     ///< Boxes and Triangles: the separation found.
};

/// Device results for one part of a front.
struct PartResults {
  float min_gap = 3e38f;                 ///< As CertificateCheck::min_gap.
  std::vector<std::uint32_t> roots;      ///< Indices of the results of the part's own pairs, by ascending slots.
  Span<const PairResult> pairs;          ///< Results of all parts.
  Span<const TrianglePairResult> tests;  ///< Triangle-pair tests of all parts, each over the whole sweep.
};

/// A pair of nodes that two siblings of a front may merge into.
struct MergeCandidate {
  std::uint32_t front = 0;  ///< Index of the front in the query.
  std::uint32_t a = 0;      ///< Node of A's tree.
  std::uint32_t b = 0;      ///< Node of B's tree.
};

}  // namespace dismantle
