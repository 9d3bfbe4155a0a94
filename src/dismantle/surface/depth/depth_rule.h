// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/surface/depth/shallow_region.h"
#include "dismantle/surface/depth/thin_places.h"
#include "dismantle/surface/solid_shape.h"

#include <limits>

namespace dismantle {

/// How deep the points of one component may get in another one [mm].
struct DepthLimits {
  /// Of all points.
  double limit = 0;
  ///@{ Where a solid is thinner than twice `limit` (ThinPlaces), that is no limit, and points could go through it.
  /// There, this is the limit of far points: those that are outside and further from its surface than `limit` in the
  /// assembled state; of points of `a` in `b`, and of `b` in `a`. Next to faces that are not at a thin place, it is
  /// `limit`. Infinite for solids that are thin nowhere; where all of a solid is thin, no more than `limit`, with which
  /// its points have none.
  double far_a = std::numeric_limits<double>::infinity(), far_b = std::numeric_limits<double>::infinity();
  ///@}
  ///@{ The other component has a hole where this one is in the assembled state. In there, and next to it up to `limit`,
  /// far points may get as deep as others.
  bool hole_for_a = false, hole_for_b = false;
  ///@}
};

/// How deep the points of one surface may get in a solid.
struct DepthRule {
  double limit = 0;      ///< Of all points [mm].
  double far_limit = 0;  ///< Of far points at thin places [mm]; no more than `limit`.
  /// The thin places; null where `far_limit` is `limit`.
  const ThinPlaces* thin = nullptr;
  /// The hole: all points inside this shape or within `limit` of it. Far points in it have the same limit as all
  /// others. Null for none.
  const SolidShape* hole = nullptr;
  /// Where no point is too deep, whether it is far or not; null where there is little to search.
  const ShallowRegion* region = nullptr;
  /// Where no point is deeper than `limit`; null where that is everywhere, or the same region.
  const ShallowRegion* wider_region = nullptr;

  /// The rule for the surface of a solid in another one. @param far_limit as DepthLimits::far_a @param hole as above
  static DepthRule of(const SolidShape& solid, double limit, double far_limit, const SolidShape* hole);

  /// Faces next to which far points may get as deep as others; null for none.
  const SurfaceTree* thick_faces() const { return thin ? thin->thick_faces() : nullptr; }
};

}  // namespace dismantle
