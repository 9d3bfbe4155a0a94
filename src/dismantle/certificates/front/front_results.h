// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/certificate_kernels.h"
#include "dismantle/core/span.h"

#include <cstdint>
#include <vector>

namespace dismantle {

class CertificateFront;

/// What a device found of a pair of nodes that a sweep has to look at.
struct PairResult {
  enum Kind : std::uint32_t {
    None,       ///< It did not look at the pair: the host does.
    Boxes,      ///< What is in `separation` certifies them as boxes.
    Split,      ///< They are not apart as boxes; of the halves of the larger one is more known.
    Triangles,  ///< Neither are they as boxes, and `separation` is that of their triangles.
  };
  static constexpr std::uint32_t kNone = 0xffffffffu;

  Kind kind = None;
  std::uint32_t part = 0;             ///< Of those that were asked for, and of a pair of the front
  std::uint32_t place = kNone;        ///< its place in that; none of what pairs were split into.
  std::uint32_t first_child = kNone;  ///< Of two answers; none where there was no room for them.
  std::uint32_t leaf = kNone;         ///< Triangles: of what their elementary test found; none where it did not test.
  NodeSeparation separation = {};
};

/// What a device found of one part of a front.
struct PartResults {
  float min_gap = 3e38f;             ///< As CertificateCheck has it.
  std::vector<std::uint32_t> roots;  ///< Answers of the pairs that do not hold, their places ascending.
  Span<const PairResult> answers;    ///< Of all parts.
};

/// A pair of nodes that two siblings of a front may merge into.
struct MergeCandidate {
  std::uint32_t front = 0;     ///< Of the fronts asked.
  std::uint32_t a = 0, b = 0;  ///< Nodes of its trees.
  Vec3f hint;                  ///< The side to stay on; zero for none.
};

/// A front whose parts are swept.
/// @tparam TrianglePairSweep tests pairs of triangles
template <class TrianglePairSweep>
struct FrontQuery {
  CertificateFront* front;
  const LinearSweep* sweep;
  const TrianglePairSweep* leaves = nullptr;  ///< The elementary tests of this sweep; null leaves them to the host.
};

}  // namespace dismantle
