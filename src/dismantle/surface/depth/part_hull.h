// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/geometry/aabb.h"
#include "dismantle/geometry/triangle.h"
#include "dismantle/math/mat3.h"

#include <array>
#include <cstdint>

namespace dismantle {

/// A triangle, or a part of one, during an interval of time: all its points move linearly.
struct MovingPart {
  Triangle own;            ///< Corners in its own frame [mm].
  Triangle begin;          ///< In the frame of the solid in which it moves [mm], at the beginning.
  Triangle end;            ///< At the end.
  double from = 0;         ///< The time at the beginning.
  double to = 1;           ///< The time at the end.
  std::uint32_t face = 0;  ///< The face that it is a part of.
  bool at_ridge = false;   ///< It was divided where two faces of the solid are as near.
  bool was_near = false;   ///< None of its points is far (DepthLimits).
};

/// The hull of all places of a moving part.
class PartHull {
 public:
  /// Of the part itself.
  explicit PartHull(const MovingPart& part);
  /// Of one or two copies of it, each shifted [mm].
  PartHull(const MovingPart& part, Span<const Vec3> shifts);

  /// The same hull along other axes, the rows of a rotation.
  PartHull turned(const Mat3& axes) const;

  /// The box around it [mm].
  const Aabb& box() const { return box_; }
  /// False if it is certainly further than `gap` from a box; across the part, it is thinner than its own box is.
  bool may_meet(const Aabb& box, double gap) const;
  /// True if some axis certainly separates it from a triangle by more than `gap` [mm].
  bool apart(const Triangle& face, double gap) const;

 private:
  PartHull() = default;
  bool apart_along(Vec3 axis, const Triangle& face, double gap) const;

  std::array<Vec3, 12> corner_;
  int count_ = 0;
  Aabb box_;
  Vec3 normal_;                   // of the part
  double lower_ = 0, upper_ = 0;  // along it
};

}  // namespace dismantle
