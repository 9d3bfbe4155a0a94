// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/audit_report.h"
#include "dismantle/core/id.h"
#include "dismantle/math/vec3.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// The rule that a pair violates.
enum class DepthRule {
  Depth,     ///< A point of one surface is deeper inside the other component than allowed.
  Crossing,  ///< A point of one surface went through the other by more than allowed; where one is a sheet, or thin.
};

/// The name of a rule in `dismantle audit --solids --json`: "depth" or "crossing".
std::string_view name_of(DepthRule rule);

/// Where a pair violates a rule.
struct DepthViolation {
  DepthRule rule = DepthRule::Depth;  ///< The rule.
  std::size_t move = 0;               ///< Index of the move.
  std::size_t frame = 0;              ///< Index of the frame at which the screw motion starts.
  double time = 0;                    ///< Time of a point that violates the rule in that motion [s of the move].
  double depth = 0;                   ///< Its depth, or how far it went through the surface [mm].
  double allowed = 0;                 ///< What is allowed at that time [mm].
  Vec3 point;                         ///< Where it is [mm, assembly frame].
  bool point_of_a = false;            ///< It is a point of the surface of a; else of b.
  double greatest = 0;                ///< The greatest depth that was found over the path [mm].
  std::string message;                ///< All of it in one sentence.
  friend bool operator==(const DepthViolation&, const DepthViolation&) = default;
};

/// A pair that overlaps in the assembled state, or that violates a rule.
struct DepthAuditPair {
  ///@{ The pair, a < b.
  ComponentId a, b;
  ///@}
  double initial_depth = 0;  ///< Depth in the assembled state [mm]: an upper bound; 0 where it is within the tolerance.
  double allowed = 0;        ///< The allowance until the pair has been apart [mm].
  bool parted = false;       ///< It overlapped, and has been apart.
  bool violated = false;     ///< It violates a rule.
  DepthViolation violation;  ///< The first violation, where there is one.
  friend bool operator==(const DepthAuditPair&, const DepthAuditPair&) = default;
};

/// Result and cost of audit_depth().
struct DepthAudit {
  std::vector<AuditViolation> inconsistencies;  ///< Of the file (AuditViolationKind::PathInconsistent).
  std::vector<DepthAuditPair> pairs;            ///< By (a, b).
  double tolerance = 0;                         ///< Of the path [mm].
  double slack = 0;        ///< A path that holds is nowhere deeper than allowed by more than this [mm].
  std::size_t sheets = 0;  ///< Number of components that bound no volume.
  std::size_t pieces = 0;  ///< Number of pieces of surface and time that were examined.
  double seconds = 0;      ///< Wall time.
  bool complete = false;   ///< False where the audit was cancelled.

  /// Number of pairs that violate a rule.
  std::size_t violation_count() const;
  /// True if the guarantee holds: the audit is complete and found nothing wrong.
  bool holds() const { return complete && inconsistencies.empty() && violation_count() == 0; }
};

}  // namespace dismantle
