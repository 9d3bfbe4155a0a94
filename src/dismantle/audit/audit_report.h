// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/path.h"
#include "dismantle/core/id.h"
#include "dismantle/math/vec3.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// The part of the guarantee (docs/guarantee.md) that a path violates.
enum class AuditViolationKind {
  PathInconsistent,  ///< The file contradicts itself or the assembly: a wrong first frame, too high an allowance, ...
  Depth,             ///< A point of one surface is deeper inside the other component than allowed.
  Crossing,          ///< A point of one surface went through the other by more than allowed; one is a sheet, or thin.
};

/// The name of a kind in `dismantle audit --json`: "path-inconsistent", "depth" or "crossing".
std::string_view name_of(AuditViolationKind kind);

/// A contradiction in the file, or the first violation of a rule by a pair.
struct AuditViolation {
  /// The value of `move` before the first one.
  static constexpr std::size_t kAssembledState = static_cast<std::size_t>(-1);

  AuditViolationKind kind = AuditViolationKind::PathInconsistent;  ///< The rule.
  std::size_t move = kAssembledState;                              ///< Index of the move.
  std::size_t frame = 0;  ///< Index of the frame at which the screw motion starts.
  double time = 0;        ///< Time of a point that violates the rule in that motion [s of the move].
  ///@{ The pair, a < b; invalid where the file does not contradict a pair.
  ComponentId a, b;
  ///@}
  double depth = 0;         ///< Depth of the point, or how far it went through the surface [mm].
  double allowed = 0;       ///< The depth that is allowed at that time [mm].
  Vec3 point;               ///< Where it is [mm, assembly frame].
  bool point_of_a = false;  ///< It is a point of the surface of a; else of b.
  double greatest = 0;      ///< The greatest depth that was found over the path [mm].
  std::string message;      ///< All of it in one sentence.
  friend bool operator==(const AuditViolation&, const AuditViolation&) = default;
};

/// A pair that has more than the tolerance for its allowance until it has been apart.
struct AuditPair {
  ///@{ The pair, a < b.
  ComponentId a, b;
  ///@}
  PathPairState state = PathPairState::Overlapping;  ///< Why: it overlaps in the assembled state, or the file says so.
  /// Depth in the assembled state [mm], an upper bound; 0 where it is within the tolerance, and for Free.
  double initial_depth = 0;
  double allowed = 0;   ///< The allowance until the pair has been apart [mm]; infinite for Free.
  bool turns = false;   ///< The allowance includes sagittas: its facets come apart and meet again as it turns.
  bool parted = false;  ///< It has been apart.
  friend bool operator==(const AuditPair&, const AuditPair&) = default;
};

/// Result and cost of audit_path().
struct AuditReport {
  std::vector<AuditViolation> violations;  ///< Of the file, then one of each pair that violates a rule, by (a, b).
  std::vector<AuditPair> pairs;            ///< By (a, b).
  double tolerance = 0;                    ///< Of the path [mm].
  double slack = 0;                        ///< A path that holds is nowhere deeper than allowed by more than this [mm].
  std::size_t sheets = 0;                  ///< Number of components that bound no volume.
  std::size_t pieces = 0;                  ///< Number of pieces of surface and time that were examined.
  double seconds = 0;                      ///< Wall time.
  bool complete = false;                   ///< False where the audit was cancelled.

  /// True if the guarantee holds: the audit is complete and found no violation. Free pairs are not part of that until
  /// they have been apart.
  bool holds() const { return complete && violations.empty(); }
  /// Number of pairs in a state.
  std::size_t count(PathPairState state) const;
};

}  // namespace dismantle
