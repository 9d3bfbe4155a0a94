// SPDX-License-Identifier: Apache-2.0
#include "dismantle/collision/leaf_sweep.h"

#include "dismantle/core/contract.h"
#include "dismantle/math/vec3f.h"

#include <algorithm>
#include <limits>

namespace dismantle {

namespace {

Triangle moved(const RigidTransform& t, const Triangle& triangle) {
  return {{t * triangle[0], t * triangle[1], t * triangle[2]}};
}

/// From the frame of one tree to that of the other.
RigidTransform between_trees(const RigidTransform& t, const ObbTree& from, const ObbTree& to) {
  return {t.rotation, t * from.origin - to.origin};
}

/// Looks for the axis of a contact: of those that the normals allow, the one along which the motion goes furthest
/// before the allowance is used up; where none has anything left to begin with, the one along which the two are least
/// deep.
class LeastBlockingAxis {
 public:
  LeastBlockingAxis(const TriangleMotion& moving, const Triangle& fixed, const OutwardNormals& normals, double allowed)
      : moving_(moving), fixed_(fixed), normals_(normals), allowed_(allowed) {}

  /// The candidates of two triangles as they are at some time.
  void consider_all(const Triangle& moving) {
    const Vec3 normal_a = normal_unscaled(moving), normal_b = normal_unscaled(fixed_);
    consider(normal_a);
    consider(normal_b);
    for (int i = 0; i < 3; ++i) {
      const Vec3 along_a = moving[(i + 1) % 3] - moving[i], along_b = fixed_[(i + 1) % 3] - fixed_[i];
      consider(cross(along_a, normal_a));
      consider(cross(along_b, normal_b));
      for (int j = 0; j < 3; ++j) consider(cross(along_a, fixed_[(j + 1) % 3] - fixed_[j]));
    }
  }

  Vec3 axis() const { return axis_; }

 private:
  void consider(Vec3 line) {
    const double size = length(line);
    if (!(size > 0)) return;
    for (const Vec3 w : {line / size, line / -size}) {
      const double gap_t0 = gap(w, moving_.t0), gap_t1 = gap(w, moving_.t1);
      double reach = gap_t0 + allowed_;  // below zero: nothing left
      if (reach >= 0) reach = gap_t1 >= -allowed_ ? 1 + gap_t1 + allowed_ : reach / (gap_t0 - gap_t1);
      if (reach <= furthest_ || !normals_.allow(w)) continue;
      furthest_ = reach;
      axis_ = w;
    }
  }

  double gap(Vec3 w, const Triangle& moving) const {
    const Vec3 origin = fixed_[0];
    const double least = std::min({0.0, dot(w, fixed_[1] - origin), dot(w, fixed_[2] - origin)});
    const double most = std::max({dot(w, moving[0] - origin), dot(w, moving[1] - origin), dot(w, moving[2] - origin)});
    return least - most;
  }

  const TriangleMotion& moving_;
  const Triangle& fixed_;
  const OutwardNormals& normals_;
  double allowed_;
  double furthest_ = -std::numeric_limits<double>::infinity();
  Vec3 axis_;
};

Triangle between(const TriangleMotion& motion, double t) {
  Triangle now;
  for (int i = 0; i < 3; ++i) now[i] = (1 - t) * motion.t0[i] + t * motion.t1[i];
  return now;
}

/// Bounds the rounding of a gap of two projections, relative to the largest coordinate.
constexpr double kDotError = 0x1p-46;

Vec3 unit_or_zero(Vec3 axis) {
  const double size = max_abs(axis);
  return size > 0 && size < std::numeric_limits<double>::infinity() ? normalized(axis / size) : Vec3{};
}

/// Whether an axis leads well out of the one face and into the other.
bool face_on(Vec3 normal_moving, Vec3 normal_fixed, Vec3 axis) {
  return dot(normal_moving, axis) > NormalCone::kLeastAhead && dot(normal_fixed, axis) < -NormalCone::kLeastAhead;
}

}  // namespace

/// Room for the normals around two faces. Of a corner with many faces, as the tip of a fan, an even choice is taken.
struct LeafSweep::Around {
  static constexpr std::uint32_t kMostOfCorner = 8;
  static constexpr std::size_t kMost = 3 * kMostOfCorner;
  Vec3 moving[kMost], fixed[kMost];

  static std::size_t gather(const SolidTree& solid, std::uint32_t face, Vec3 (&to)[kMost]) {
    std::size_t count = 0;
    for (const std::uint32_t v : solid.faces[face].v) {
      const std::uint32_t begin = solid.around_begin[v], end = solid.around_begin[v + 1];
      const std::uint32_t stride = (end - begin + kMostOfCorner - 1) / kMostOfCorner;
      for (std::uint32_t k = begin; k < end; k += stride)
        if (solid.around[k] != face) to[count++] = solid.normals[solid.around[k]];
    }
    return count;
  }
};

LeafSweep::LeafSweep(const SolidTree& moving, const SolidTree& fixed, const Pose& start, const Pose& end,
                     double deviation, const LeafRules& rules)
    : moving_(&moving),
      fixed_(&fixed),
      start_(transform_from_pose(start)),
      end_(transform_from_pose(end)),
      start_pose_(start),
      end_pose_(end),
      deviation_(deviation),
      share_(kArcShare * rules.tolerance),
      allowed_(rules.allowed - std::max(share_, deviation)),
      rules_(rules) {
  DISMANTLE_EXPECT(rules.allowed >= rules.tolerance && rules.tolerance > 0 && allowed_ > 0);
  middle_ = start_.rotation == end_.rotation ? start_.rotation : mat3_from_quat(pose_between(start, end, 0.5).rotation);
}

PairMotion LeafSweep::motion() const {
  PairMotion motion;
  motion.t0 = between_trees(start_, moving_->tree, fixed_->tree);
  motion.t1 = between_trees(end_, moving_->tree, fixed_->tree);
  motion.middle = middle_;
  motion.allowed = rules_.allowed - share_;
  motion.deviation = std::max(0.0, deviation_ - share_);
  motion.kept = share_;
  motion.back = screw_between(inverse(start_pose_), inverse(end_pose_));
  motion.back.reference -= moving_->tree.origin;
  return motion;
}

bool LeafSweep::never_meet(std::uint32_t face_moving, std::uint32_t face_fixed, Vec3& axis) const {
  const Triangle moving = moving_->triangle(face_moving), fixed = fixed_->triangle(face_fixed);
  const AxisCcdResult found =
      ccd_triangle_triangle({moved(start_, moving), moved(end_, moving)}, {fixed, fixed}, 0, axis, rules_.limits);
  if (found.ccd.status != CcdStatus::Free) return false;
  axis = found.axis;
  return true;
}

double LeafSweep::least_gap(std::uint32_t face_moving, std::uint32_t face_fixed, Vec3 axis) const {
  const Triangle moving = moving_->triangle(face_moving), fixed = fixed_->triangle(face_fixed);
  double least = std::numeric_limits<double>::infinity(), most = -least, reach = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 t0 = start_ * moving[i], t1 = end_ * moving[i];
    least = std::min(least, dot(axis, fixed[i]));
    most = std::max({most, dot(axis, t0), dot(axis, t1)});
    reach = std::max({reach, max_abs(fixed[i]), max_abs(t0), max_abs(t1)});
  }
  // The axis is of unit length to a few u.
  return least - most - deviation_ - kDotError * reach;
}

LeafSweep::Result LeafSweep::test(std::uint32_t face_moving, std::uint32_t face_fixed, Vec3 hint,
                                  double horizon) const {
  Result result;
  result.contact = {face_moving, face_fixed, 1, hint};
  const Triangle own = moving_->triangle(face_moving);
  const Pair pair{face_moving, face_fixed, moved(start_, own), fixed_->triangle(face_fixed)};
  TriangleMotion motion{pair.moving, moved(end_, own)};
  if (!still_parts(motion, pair, hint)) {
    if (horizon < 1) motion.t1 = between(motion, horizon);
    const AxisCcdResult found = test_chords(motion, pair, hint);
    result.free = found.ccd.status == CcdStatus::Free;
    result.contact.axis = found.axis;
    if (!result.free) result.contact.toi = horizon * found.ccd.toi;
  }
  result.contact.axis = unit_or_zero(result.contact.axis);
  result.gap = least_gap(face_moving, face_fixed, result.contact.axis);
  result.harmless = result.gap > 0;
  const bool asks = rules_.tells_harmless && rules_.sides == SideRule::Normals && horizon == 1;
  if (result.harmless || !result.free || !asks) return result;
  Vec3 axis = result.contact.axis;
  if (face_on(middle_ * moving_->normals[face_moving], fixed_->normals[face_fixed], axis)) {
    result.harmless = true;
  } else if (never_meet(face_moving, face_fixed, axis)) {
    result.harmless = true;
    // What parts them without any allowance is worth more the next time.
    axis = unit_or_zero(axis);
    const double gap = least_gap(face_moving, face_fixed, axis);
    if (gap > result.gap) {
      result.contact.axis = axis;
      result.gap = gap;
    }
  }
  return result;
}

OutwardNormals LeafSweep::normals_of(const Pair& pair, const Mat3& rotation, Around& around) const {
  const std::size_t count_moving = Around::gather(*moving_, pair.face_moving, around.moving);
  const std::size_t count_fixed = Around::gather(*fixed_, pair.face_fixed, around.fixed);
  for (std::size_t k = 0; k < count_moving; ++k) around.moving[k] = rotation * around.moving[k];
  return {normal_unscaled(pair.moving),
          normal_unscaled(pair.fixed),
          {around.moving, count_moving},
          {around.fixed, count_fixed}};
}

Vec3 LeafSweep::side_of(const Triangle& moving, const Triangle& fixed) const {
  const TriangleMotion now{moving, moving}, still{fixed, fixed};
  AxisCcdResult found = ccd_triangle_triangle(now, still, 0, Vec3{}, rules_.limits);
  if (found.ccd.status == CcdStatus::Free) return found.axis;
  const OutwardNormals normals{normal_unscaled(moving), normal_unscaled(fixed), {}, {}};
  found = ccd_triangle_triangle(now, still, allowed_, Vec3{}, normals, rules_.limits);
  return found.ccd.status == CcdStatus::Free ? found.axis : Vec3{};
}

AxisCcdResult LeafSweep::test_chords(const TriangleMotion& moving, const Pair& pair, Vec3 hint) const {
  const Triangle& fixed = pair.fixed;
  const TriangleMotion still{fixed, fixed};
  if (rules_.sides == SideRule::Memory) {
    if (length_squared(hint) == 0) hint = side_of(moving.t0, fixed);
    AxisCcdResult found = ccd_triangle_triangle(moving, still, allowed_, hint, rules_.limits);
    // Stopped, the pair stays on the side that it was on: what the search ended on may be another.
    if (found.ccd.status == CcdStatus::Contact && still_parts({moving.t0, moving.t0}, pair, hint)) found.axis = hint;
    return found;
  }
  if (rules_.sides == SideRule::Free) {
    const AxisCcdResult found = ccd_triangle_triangle(moving, still, allowed_, hint, rules_.limits);
    if (found.ccd.status == CcdStatus::Free || length_squared(hint) == 0) return found;
    // Bound to the side of the hint it was stopped: the least blocking axis may be on another.
    const AxisCcdResult unbound = ccd_triangle_triangle(moving, still, allowed_, Vec3{}, rules_.limits);
    return unbound.ccd.toi > found.ccd.toi ? unbound : found;
  }
  Around around;
  const OutwardNormals normals = normals_of(pair, start_.rotation, around);
  AxisCcdResult found = ccd_triangle_triangle(moving, still, allowed_, hint, normals, rules_.limits);
  if (found.ccd.status == CcdStatus::Free) return found;
  // The axis that it ended on may be one that only held by chance: the response needs the one of the contact.
  LeastBlockingAxis least(moving, fixed, normals, allowed_);
  least.consider_all(moving.t0);
  if (found.ccd.toi > 0) least.consider_all(between(moving, found.ccd.toi));
  if (length_squared(least.axis()) > 0) found.axis = least.axis();
  if (found.ccd.toi > 0) return found;
  // Where no axis that the normals allow parts them to begin with (overlaps of tessellations), any other may.
  const TriangleMotion start{moving.t0, moving.t0};
  if (ccd_triangle_triangle(start, still, allowed_, hint, normals, rules_.limits).ccd.status == CcdStatus::Free)
    return found;
  return ccd_triangle_triangle(moving, still, allowed_, Vec3{}, rules_.limits);
}

bool LeafSweep::still_parts(const TriangleMotion& moving, const Pair& pair, Vec3 axis) const {
  const Triangle &t0 = moving.t0, &t1 = moving.t1;
  const double size = length(axis);
  if (!(size > 0.5 && size < 2)) return false;
  double least = dot(axis, pair.fixed[0]), most = std::max(dot(axis, t0[0]), dot(axis, t1[0])), reach = 0;
  for (int i = 0; i < 3; ++i) {
    least = std::min(least, dot(axis, pair.fixed[i]));
    most = std::max({most, dot(axis, t0[i]), dot(axis, t1[i])});
    reach = std::max({reach, max_abs(pair.fixed[i]), max_abs(t0[i]), max_abs(t1[i])});
  }
  // Two dot products of coordinates up to `reach`, each off by less than 8 u of three of them.
  const double gap = least - most - kDotError * reach;
  double usable = allowed_;
  if (rules_.sides == SideRule::Normals) {
    usable = OutwardNormals{normal_unscaled(t0), normal_unscaled(pair.fixed), {}, {}}.allowance(axis, allowed_);
    Around around;
    if (usable < allowed_ && gap < -usable)
      usable = normals_of(pair, start_.rotation, around).allowance(axis, allowed_);
  }
  return gap >= -usable * std::min(1.0, size) * (1 - kDotError);
}

Certificate LeafSweep::certificate(const Result& found, const LinearSweep& sweep) const {
  const std::uint32_t face_moving = found.contact.face_moving, face_fixed = found.contact.face_fixed;
  const Vec3 axis = found.contact.axis;
  const bool meet = !(found.gap > 0);
  Certificate c;
  c.axis = to_float(axis);
  c.offset = kNoCertificate;
  if (length_squared(axis) == 0) return c;

  const Triangle moving = moving_->triangle(face_moving), fixed = fixed_->triangle(face_fixed);
  const Vec3 origin = moving_->tree.origin;
  c.hull.kind = NodeHull::kTriangle;
  c.hull.center = to_float(moving[0] - origin);
  for (int i = 0; i < 2; ++i) c.hull.span[i] = to_float(moving[i + 1] - origin - to_double(c.hull.center));
  const Vec3 w = to_double(c.axis);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) least = std::min(least, dot(w, fixed[i] - fixed_->tree.origin));
  // An axis against the normals says something only without the allowance.
  double usable = rules_.allowed;
  if (rules_.sides == SideRule::Normals) {
    const Mat3 middle{{to_double(sweep.middle[0]), to_double(sweep.middle[1]), to_double(sweep.middle[2])}};
    const Triangle turned{{middle * moving[0], middle * moving[1], middle * moving[2]}};
    const Vec3 own = middle * moving_->normals[face_moving], other = fixed_->normals[face_fixed];
    usable = OutwardNormals{own, other, {}, {}}.allowance(w, rules_.allowed);
    // On edge the allowance is only for those that need it: others may be apart along another axis when they do.
    const bool on_edge = !face_on(own, other, w);
    if (on_edge && !meet) usable = std::min(0.0, usable);
    Around around;
    if (usable < rules_.allowed && meet)
      usable = normals_of({face_moving, face_fixed, turned, fixed}, middle, around).allowance(w, rules_.allowed);
    if (usable > 0 && on_edge) c.hull.kind = NodeHull::kTriangleOnEdge;
  }
  // What the front allows is taken off where none of it may be used.
  const double taken_off = usable < rules_.allowed ? static_cast<double>(sweep.allowed) - std::min(0.0, usable) : 0;
  c.offset = -rounded_up(taken_off - least);
  return c;
}

}  // namespace dismantle
