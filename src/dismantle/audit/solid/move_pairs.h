// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/solid/move_depths.h"

#include <algorithm>

namespace dismantle::audit {

/// A pair in one move.
struct MovePair {
  ///@{ The components; b moves.
  std::uint32_t a = 0, b = 0;
  ///@}
  Pose pose_a;               ///< Where a stands.
  DepthPair pair;            ///< The motion of b relative to a.
  double allowed = 0;        ///< Before it is apart [mm].
  bool joined = false;       ///< It has an allowance of its own, and has not been apart before the move.
  std::uint32_t parted = 0;  ///< The first segment at whose start it has been apart.
  /// The components in the order of their indices.
  std::pair<std::uint32_t, std::uint32_t> key() const { return std::minmax(a, b); }
};

/// The pairs of a moving and a stationary component in a move that come near each other.
struct MovePairs {
  std::size_t move = 0;                 ///< Index of the move.
  std::vector<MotionSegment> segments;  ///< Of the move.
  std::vector<MovePair> pairs;          ///< By (a, b).
};

/// The pairs of move `index`. @param poses of all components before it
MovePairs find_move_pairs(const DepthContext& context, Span<const Pose> poses, std::size_t index);

/// Finds the segments from which on pairs with allowances of their own have been apart; false where it was cancelled.
bool part_move_pairs(DepthContext& context, MovePairs& move, double progress_from, double progress_to);

/// Enters a violation of a pair in the ledger, if it is its first, and returns its entry.
LedgerEntry& enter_violation(DepthContext& context, const MovePairs& move, const MovePair& pair,
                             const AuditViolation& violation);

/// Follows points of sheets, thin components and what comes near them through the move, and enters those that pass
/// through a surface in the ledger; false where it was cancelled.
bool check_move_crossings(DepthContext& context, const MovePairs& move, double progress_from, double progress_to);

}  // namespace dismantle::audit
