// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/ghosts/displaced_faces.h"
#include "dismantle/certificates/ghosts/near_face_pairs.h"

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace dismantle {

/// A component whose whole surface is to be shifted, and another one that it touches in the assembled state.
struct ShiftRequest {
  const SolidTree* own = nullptr;             ///< The component; never null.
  const SolidTree* other = nullptr;           ///< The other one; never null.
  const DisplacedFaces* displaced = nullptr;  ///< The faces of `own` against `other`; never null.
  const FacePairs* near = nullptr;            ///< Pairs that may touch, of `own` and of `other`; never null.
  Span<const Vec3> off;             ///< Vertices that are displaced to the right side [mm]; none: either side will do.
  std::array<double, 2> lengths{};  ///< Of the shifts that are tried, in this order [mm].
  double touching = 0;              ///< Faces that are no further apart than that touch [mm].
  bool may_contain = false;         ///< As DisplacedFaces::apart() takes it.
};

/// The whole surface shifted away from the other one, if nothing is in the way: thin parts and sheets can then slide
/// along what they touch, and their other side stays clear of it.
/// @return the shifted vertices [mm]; nothing where no shift is free
std::optional<std::vector<Vec3>> shifted_ghost(const ShiftRequest& request);

}  // namespace dismantle
