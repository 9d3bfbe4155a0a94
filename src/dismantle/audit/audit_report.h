// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/id.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// The part of the guarantee (docs/formats.md, "Path") that a path violates.
enum class AuditViolationKind {
  PathInconsistent,    ///< The file contradicts itself or the assembly: a wrong first frame, an unknown name, ...
  TrianglesIntersect,  ///< The depth of two triangles is above the pair's allowance.
  VertexInside,        ///< A vertex is deeper than twice the allowance inside a closed component.
  EmbeddedMetAgain,    ///< An embedded pair parted and then violated one of the two rules above.
};

/// The name of a kind in `dismantle audit --json`: "path-inconsistent", "triangles-intersect", "vertex-inside" or
/// "embedded-met-again".
std::string_view name_of(AuditViolationKind kind);

/// The first violation of one rule by one pair in one move, and the largest depth in that screw motion. The rest of the
/// move is not checked for the pair.
struct AuditViolation {
  /// The value of `move` before the first one.
  static constexpr std::size_t kAssembledState = static_cast<std::size_t>(-1);

  AuditViolationKind kind = AuditViolationKind::PathInconsistent;  ///< The rule.
  std::size_t move = kAssembledState;                              ///< Index of the move.
  std::size_t frame = 0;  ///< Index of the frame at which the screw motion starts.
  double time = 0;        ///< Time of the first sample that violates the rule [s of the move].
  ///@{ The pair, a < b; invalid for PathInconsistent.
  ComponentId a, b;
  ///@}
  double depth = 0;     ///< Largest depth at a sample of the screw motion [mm].
  double allowed = 0;   ///< The depth that the rule allows [mm].
  std::string message;  ///< All of it in one sentence.
  friend bool operator==(const AuditViolation&, const AuditViolation&) = default;
};

/// The largest depth of the triangles of a pair, allowed or not.
struct AuditPairDepth {
  ///@{ The pair, a < b.
  ComponentId a, b;
  ///@}
  double deepest = 0;  ///< Largest depth over all samples [mm].
  double allowed = 0;  ///< The pair's allowance [mm].
  friend bool operator==(const AuditPairDepth&, const AuditPairDepth&) = default;
};

/// Result and cost of an audit.
struct AuditReport {
  std::vector<AuditViolation> violations;  ///< In the order of the path; within a move by (a, b, kind).
  std::vector<AuditPairDepth> depths;      ///< Pairs with a depth above 0 by (a, b), except embedded ones.
  double tolerance = 0;                    ///< Of the path [mm].
  double resolution = 0;    ///< Largest relative movement between two samples that no certificate covers [mm].
  std::size_t samples = 0;  ///< Number of exact depths and signed distances evaluated.
  double seconds = 0;       ///< Wall time.
  bool complete = false;    ///< False where the audit was cancelled.

  /// True if the guarantee holds: the audit is complete and found no violation.
  bool holds() const { return complete && violations.empty(); }
};

}  // namespace dismantle
