// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/surface/solid_shape.h"

#include <memory>

namespace dismantle {

/// Where a solid is so thin that a limit of depth does not keep anything from passing through it. A face is at a thin
/// place where another one faces it from the other side of the material, nearly parallel and no further away than twice
/// the limit: half-way between the two, no point is too deep. All faces are, where no point of the solid is deeper than
/// the limit.
class ThinPlaces {
 public:
  /// @param limit of depth [mm]
  ThinPlaces(const SolidShape& solid, double limit);

  /// True if no face is at a thin place.
  bool none() const { return is_none_; }
  /// True if no point of the solid is deeper than the limit.
  bool everywhere() const { return is_everywhere_; }
  ///@{ The faces that are at a thin place, and the others, each with numbers of their own; null where all are, or none.
  const SurfaceTree* thin_faces() const { return thin_.get(); }
  const SurfaceTree* thick_faces() const { return thick_.get(); }
  ///@}

 private:
  bool is_none_ = false, is_everywhere_ = false;
  std::unique_ptr<const SurfaceTree> thin_, thick_;
};

}  // namespace dismantle
