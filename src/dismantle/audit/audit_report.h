// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/id.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// Which part of the guarantee (docs/formats.md, "Path") a path breaks.
enum class AuditViolationKind {
  PathInconsistent,    ///< The file contradicts itself or the assembly: a wrong first frame, an unknown name, ...
  TrianglesIntersect,  ///< Two triangles intersect by more than the pair is allowed.
  VertexInside,        ///< A vertex lies deeper than twice the allowance inside another closed component.
  EmbeddedMetAgain,    ///< An embedded pair was apart and then broke one of the two rules above.
};

/// "path-inconsistent", "triangles-intersect", "vertex-inside", "embedded-met-again": as `dismantle audit --json` has
/// it.
std::string_view name_of(AuditViolationKind kind);

/// One rule broken by one pair in one move: when it was first seen, and the deepest that was seen in that screw. The
/// rest of the move is not looked at for the pair.
struct AuditViolation {
  static constexpr std::size_t kAssembledState = static_cast<std::size_t>(-1);

  AuditViolationKind kind = AuditViolationKind::PathInconsistent;
  std::size_t move = kAssembledState;  ///< Index of the move; kAssembledState before the first one.
  std::size_t frame = 0;               ///< The frame at which the screw starts that breaks the rule first.
  double time = 0;                     ///< When it was first seen [s of the move].
  ComponentId a, b;                    ///< a < b; invalid for PathInconsistent.
  double depth = 0;                    ///< The deepest seen in the screw from that frame [mm].
  double allowed = 0;                  ///< What that depth may be [mm].
  std::string message;                 ///< One sentence that says it all.
  friend bool operator==(const AuditViolation&, const AuditViolation&) = default;
};

/// How deep the triangles of a pair were seen in each other, allowed or not.
struct AuditPairDepth {
  ComponentId a, b;    ///< a < b
  double deepest = 0;  ///< Over all samples [mm].
  double allowed = 0;  ///< [mm]
  friend bool operator==(const AuditPairDepth&, const AuditPairDepth&) = default;
};

/// What an audit found, and what it cost.
struct AuditReport {
  std::vector<AuditViolation> violations;  ///< In the order of the path; within a move by (a, b, kind).
  std::vector<AuditPairDepth> depths;      ///< Pairs that were seen deeper than 0, by (a, b); not those embedded.
  double tolerance = 0;                    ///< Of the path [mm].
  double resolution = 0;    ///< The largest relative movement between two samples that nothing certifies [mm].
  std::size_t samples = 0;  ///< Exact depths and signed distances evaluated.
  double seconds = 0;       ///< Wall time.
  bool complete = false;    ///< False where the audit was cancelled.

  /// True where the guarantee holds: everything was looked at, and nothing is wrong.
  bool holds() const { return complete && violations.empty(); }
};

}  // namespace dismantle
