// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/depth/part_hull.h"

#include <algorithm>
#include <cmath>

namespace dismantle {

namespace {

constexpr Vec3 kUnshifted;

}  // namespace

PartHull::PartHull(const MovingPart& part) : PartHull(part, Span<const Vec3>(&kUnshifted, 1)) {}

PartHull::PartHull(const MovingPart& part, Span<const Vec3> shifts) {
  for (const Vec3& shift : shifts)
    for (const Triangle* t : {&part.begin, &part.end})
      for (const Vec3& p : t->corner) {
        corner_[count_++] = p + shift;
        box_.extend(p + shift);
      }
  normal_ = normalized(normal_unscaled(part.begin));
  lower_ = upper_ = dot(normal_, corner_[0]);
  for (int i = 1; i < count_; ++i) {
    lower_ = std::min(lower_, dot(normal_, corner_[i]));
    upper_ = std::max(upper_, dot(normal_, corner_[i]));
  }
}

PartHull PartHull::turned(const Mat3& axes) const {
  PartHull hull;
  hull.count_ = count_;
  for (int i = 0; i < count_; ++i) hull.box_.extend(hull.corner_[i] = axes * corner_[i]);
  hull.normal_ = axes * normal_;
  hull.lower_ = lower_;
  hull.upper_ = upper_;
  return hull;
}

bool PartHull::may_meet(const Aabb& box, double gap) const {
  if (!overlaps(box_, {box.lower - Vec3{gap, gap, gap}, box.upper + Vec3{gap, gap, gap}})) return false;
  const Vec3 half = (box.upper - box.lower) / 2;
  const double reach =
      std::abs(normal_.x) * half.x + std::abs(normal_.y) * half.y + std::abs(normal_.z) * half.z + 2 * gap;
  const double middle = dot(normal_, box.center());
  return middle - reach <= upper_ && middle + reach >= lower_;
}

bool PartHull::apart(const Triangle& face, double gap) const {
  if (apart_along(normal_unscaled(face), face, gap)) return true;
  const Triangle begin{{corner_[0], corner_[1], corner_[2]}};
  if (apart_along(normal_unscaled(begin), face, gap)) return true;
  const Vec3 way = corner_[3] - corner_[0];
  for (int i = 0; i < 3; ++i) {
    const Vec3 edge = face[(i + 1) % 3] - face[i];
    for (int k = 0; k < 3; ++k)
      if (apart_along(cross(begin[(k + 1) % 3] - begin[k], edge), face, gap)) return true;
    if (apart_along(cross(way, edge), face, gap)) return true;
  }
  return false;
}

bool PartHull::apart_along(Vec3 axis, const Triangle& face, double gap) const {
  const double size = length(axis);
  if (!(size > 0)) return false;
  double lower = dot(axis, corner_[0]), upper = lower;
  for (int i = 1; i < count_; ++i) {
    const double along = dot(axis, corner_[i]);
    lower = std::min(lower, along);
    upper = std::max(upper, along);
  }
  const double f[3] = {dot(axis, face[0]), dot(axis, face[1]), dot(axis, face[2])};
  return std::min({f[0], f[1], f[2]}) - upper > gap * size || lower - std::max({f[0], f[1], f[2]}) > gap * size;
}

}  // namespace dismantle
