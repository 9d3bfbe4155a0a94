// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/certificate_kernels.h"
#include "dismantle/certificates/ghosts/overlap_retraction.h"
#include "dismantle/engine/chords.h"

#include <array>
#include <optional>
#include <vector>

namespace dismantle {

/// Ghost surfaces are displaced by at most this share of the tolerance, and the depth of an overlap: the rest of the
/// tolerance is for the arcs' deviation.
inline constexpr double kGhostLength = (1 - kArcShare) * (1 - 1e-6);
static_assert(kGhostLength + kArcShare < 1, "together they are at most the tolerance");

/// Two components that touch or overlap in the assembled state.
struct PairGhostRequest {
  OverlapSide a;                       ///< One of them.
  OverlapSide b;                       ///< The other one.
  const SolidTree* ghost_a = nullptr;  ///< The ghost surface that `a` has against all others; never null.
  const SolidTree* ghost_b = nullptr;  ///< That of `b`.
  double depth = 0;                    ///< Of the pair, an upper bound; or what it may be less the tolerance [mm].
  double everywhere = 0;               ///< All faces are retracted by this, wherever the two overlap [mm].
  double tolerance = 0;                ///< [mm]
  FrontKernels kernels;                ///< Any.
};

/// The ghost surfaces of a pair.
struct PairGhosts {
  /// Displaced vertices of `a` and `b` [mm, assembled]; empty where they need no ghosts of their own.
  std::array<std::vector<Vec3>, 2> vertices;
  double max_length = 0;  ///< Largest displacement [mm].
  double turning = 0;     ///< Depth that cylinders need to turn in each other [mm]; 0 where none do.
  /// All faces are only retracted into their solids, so that no thin part is on the far side of what it touches while
  /// its ghost is on the near side.
  bool retracted = true;
};

/// Finds ghost surfaces that are apart from the other component in the assembled state
/// (docs/design/0012-ghost-surfaces.md): the ones that the components have, if these are well apart; else those whose
/// overlapping patches, or those of them that matter, are retracted out of each other, and others are displaced further
/// where that is not enough. Displacements are no longer than the depth plus most of the tolerance; or up to
/// kMaxGhostFactor times that, at corners, where no point gets deeper in its solid than that. Nothing where none are
/// found.
std::optional<PairGhosts> find_pair_ghosts(const PairGhostRequest& request);

/// The largest displacement as a multiple of the depth plus the tolerance.
inline constexpr double kMaxGhostFactor = 2;

}  // namespace dismantle
