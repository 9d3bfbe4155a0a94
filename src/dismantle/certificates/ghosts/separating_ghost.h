// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/surface/solid_tree.h"

#include <optional>
#include <utility>
#include <vector>

namespace dismantle {

/// A component whose ghost surface is wanted, and another one that it touches in the assembled state.
struct GhostRequest {
  const SolidTree* own = nullptr;    ///< The component; never null.
  const SolidTree* other = nullptr;  ///< The other one; never null.
  Span<const Vec3> start;            ///< Displaced vertices to start from [mm].
  /// Pairs of faces, of `own` and of `other`, that may come nearer to each other than max_length + gap.
  Span<const std::pair<std::uint32_t, std::uint32_t>> near;
  double max_length = 0;  ///< Largest displacement of a vertex [mm].
  double gap = 0;         ///< Distance from `other` to reach [mm].
  /// Where neither component has an outside: `own` counts as the one whose normals tell the side.
  bool own_is_oriented = true;
};

/// Displaces vertices of a component further until its faces are apart from the other component in the assembled state:
/// each pair of faces that is not yet apart bounds the displacements of its corners along the axis that needs the
/// least, and the shortest displacements within all bounds are taken, over and over. Sides follow from the outward
/// normals of closed components.
/// @return the displaced vertices [mm]; nothing where no displacements of the length are found
std::optional<std::vector<Vec3>> separating_ghost(const GhostRequest& request);

}  // namespace dismantle
