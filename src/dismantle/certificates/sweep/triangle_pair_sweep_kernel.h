// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/obb_tree.h"
#include "dismantle/certificates/front/paired_trees.h"
#include "dismantle/geometry/triangle_mesh.h"
#include "dismantle/math/rigid_transform.h"
#include "dismantle/narrowphase/ccd_triangle_triangle.h"

#include <cstdint>
#include <limits>

namespace dismantle {

/// A SolidTree's triangles and what is known of their outside, wherever they are.
struct SolidView {
  const Vec3* vertices = nullptr;
  const Face* faces = nullptr;
  const Vec3* normals = nullptr;  ///< This and what follows only where the solid has an outside.
  const std::uint32_t* around_begin = nullptr;
  const std::uint32_t* around = nullptr;

  DISMANTLE_HOST_DEVICE Triangle triangle(std::uint32_t face) const {
    const Face& f = faces[face];
    return {{vertices[f.v[0]], vertices[f.v[1]], vertices[f.v[2]]}};
  }
};

/// Where two triangles are stopped.
struct LeafContact {
  std::uint32_t face_moving = 0, face_fixed = 0;
  double toi = 0;  ///< They are certainly allowed on [0, toi].
  Vec3 axis;  ///< Unit, from the moving to the fixed one [frame of the fixed component]; zero where none parts them.
};

/// What a test of two triangles found.
struct TrianglePairResult {
  bool free = true;
  double gap = 0;         ///< Lower bound of their distance during the whole motion, by the axis [mm].
  bool harmless = false;  ///< They do not meet at all but for the arcs, or face on face: closed solids only.
  LeafContact contact;    ///< The axis is given also where free.
};

/// What decides whether two triangles may go on.
struct TrianglePairRules {
  double allowed = 0;    ///< How deep triangles may be in each other [mm].
  double tolerance = 0;  ///< [mm]
  SideRule sides = SideRule::Memory;
  AdvancementLimits limits;
  bool tells_harmless = true;  ///< Whether it is worth the time to find what TrianglePairResult::harmless tells.
};

namespace detail {

/// Bounds the rounding of a gap of two projections, relative to the largest coordinate.
inline constexpr double kDotError = 0x1p-46;

DISMANTLE_HOST_DEVICE inline double least(double a, double b) {
  return b < a ? b : a;
}
DISMANTLE_HOST_DEVICE inline double most(double a, double b) {
  return a < b ? b : a;
}

DISMANTLE_HOST_DEVICE inline Triangle moved(const RigidTransform& t, const Triangle& triangle) {
  return {{t * triangle[0], t * triangle[1], t * triangle[2]}};
}

DISMANTLE_HOST_DEVICE inline Triangle between(const TriangleMotion& motion, double t) {
  Triangle now;
  for (int i = 0; i < 3; ++i) now[i] = (1 - t) * motion.t0[i] + t * motion.t1[i];
  return now;
}

DISMANTLE_HOST_DEVICE inline Vec3 unit_or_zero(Vec3 axis) {
  const double size = max_abs(axis);
  return size > 0 && size < std::numeric_limits<double>::infinity() ? normalized(axis / size) : Vec3{};
}

/// Whether an axis leads well out of the one face and into the other.
DISMANTLE_HOST_DEVICE inline bool face_on(Vec3 normal_moving, Vec3 normal_fixed, Vec3 axis) {
  return dot(normal_moving, axis) > NormalCone::kMinAhead && dot(normal_fixed, axis) < -NormalCone::kMinAhead;
}

/// Looks for the axis of a contact: of those that the normals allow, the one along which the motion goes furthest
/// before the allowance is used up; where none has anything left to begin with, the one along which the two are least
/// deep.
class LeastBlockingAxis {
 public:
  DISMANTLE_HOST_DEVICE LeastBlockingAxis(const TriangleMotion& moving, const Triangle& fixed,
                                          const OutwardNormals& normals, double allowed)
      : moving_(moving), fixed_(fixed), normals_(normals), allowed_(allowed) {}

  /// The candidates of two triangles as they are at some time.
  DISMANTLE_HOST_DEVICE void consider_all(const Triangle& moving) {
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

  DISMANTLE_HOST_DEVICE Vec3 axis() const { return axis_; }

 private:
  DISMANTLE_HOST_DEVICE void consider(Vec3 line) {
    const double size = length(line);
    if (!(size > 0)) return;
    for (int side = 0; side < 2; ++side) {
      const Vec3 w = line / (side == 0 ? size : -size);
      const double gap_t0 = gap(w, moving_.t0), gap_t1 = gap(w, moving_.t1);
      double reach = gap_t0 + allowed_;  // below zero: nothing left
      if (reach >= 0) reach = gap_t1 >= -allowed_ ? 1 + gap_t1 + allowed_ : reach / (gap_t0 - gap_t1);
      if (reach <= furthest_ || !normals_.allow(w)) continue;
      furthest_ = reach;
      axis_ = w;
    }
  }

  DISMANTLE_HOST_DEVICE double gap(Vec3 w, const Triangle& moving) const {
    const Vec3 origin = fixed_[0];
    const double low = least(least(0.0, dot(w, fixed_[1] - origin)), dot(w, fixed_[2] - origin));
    const double high = most(most(dot(w, moving[0] - origin), dot(w, moving[1] - origin)), dot(w, moving[2] - origin));
    return low - high;
  }

  const TriangleMotion& moving_;
  const Triangle& fixed_;
  const OutwardNormals& normals_;
  double allowed_;
  double furthest_ = -std::numeric_limits<double>::infinity();
  Vec3 axis_;
};

}  // namespace detail

/// The test of two triangles in a TrianglePairSweep: the same text for the CPU and CUDA. Solids are where it runs.
struct TrianglePairSweepKernel {
  SolidView moving, fixed;
  RigidTransform start, end;  ///< Of the moving component in the fixed one's frame.
  Mat3 middle;                ///< Its rotation half way.
  double deviation = 0;       ///< As TrianglePairSweep has it [mm].
  double allowed = 0;         ///< What the arcs leave of the allowance [mm].
  TrianglePairRules rules;

  /// Two faces, their triangles as the motion begins.
  struct Pair {
    std::uint32_t face_moving, face_fixed;
    Triangle moving, fixed;
  };
  /// Room for the normals around two faces. Of a corner with many faces, as the tip of a fan, an even choice is taken.
  struct Around {
    static constexpr std::uint32_t kMaxOfCorner = 8;
    static constexpr std::size_t kMax = 3 * kMaxOfCorner;
    Vec3 moving[kMax], fixed[kMax];
  };

  /// As TrianglePairSweep::test().
  DISMANTLE_HOST_DEVICE TrianglePairResult test(std::uint32_t face_moving, std::uint32_t face_fixed, Vec3 hint,
                                                double horizon) const {
    TrianglePairResult result;
    result.contact = {face_moving, face_fixed, 1, hint};
    const Triangle own = moving.triangle(face_moving);
    const Pair pair{face_moving, face_fixed, detail::moved(start, own), fixed.triangle(face_fixed)};
    TriangleMotion motion{pair.moving, detail::moved(end, own)};
    if (!still_parts(motion, pair, hint)) {
      if (horizon < 1) motion.t1 = detail::between(motion, horizon);
      const AxisCcdResult found = test_chords(motion, pair, hint);
      result.free = found.ccd.status == CcdStatus::Free;
      result.contact.axis = found.axis;
      if (!result.free) result.contact.toi = horizon * found.ccd.toi;
    }
    result.contact.axis = detail::unit_or_zero(result.contact.axis);
    result.gap = min_gap(face_moving, face_fixed, result.contact.axis);
    result.harmless = result.gap > 0;
    const bool asks = rules.tells_harmless && rules.sides == SideRule::Normals && horizon == 1;
    if (!result.harmless && result.free && asks) look_for_harm(result);
    return result;
  }

  /// Fills in the normals around both faces, the moving one's turned by `rotation`.
  DISMANTLE_HOST_DEVICE OutwardNormals normals_of(const Pair& pair, const Mat3& rotation, Around& around) const {
    const std::size_t count_moving = gather(moving, pair.face_moving, around.moving);
    const std::size_t count_fixed = gather(fixed, pair.face_fixed, around.fixed);
    for (std::size_t k = 0; k < count_moving; ++k) around.moving[k] = rotation * around.moving[k];
    return {normal_unscaled(pair.moving),
            normal_unscaled(pair.fixed),
            {around.moving, count_moving},
            {around.fixed, count_fixed}};
  }

 private:
  /// Whether two triangles that are free, but not apart by the axis, lie face on face or never meet.
  DISMANTLE_HOST_DEVICE void look_for_harm(TrianglePairResult& result) const {
    const std::uint32_t face_moving = result.contact.face_moving, face_fixed = result.contact.face_fixed;
    Vec3 axis = result.contact.axis;
    if (detail::face_on(middle * moving.normals[face_moving], fixed.normals[face_fixed], axis)) {
      result.harmless = true;
    } else if (never_meet(face_moving, face_fixed, axis)) {
      result.harmless = true;
      // What parts them without any allowance is worth more the next time.
      axis = detail::unit_or_zero(axis);
      const double gap = min_gap(face_moving, face_fixed, axis);
      if (gap > result.gap) {
        result.contact.axis = axis;
        result.gap = gap;
      }
    }
  }

  /// Whether the two are apart throughout, beginning with the axis, which becomes the one that parts them at the end.
  DISMANTLE_HOST_DEVICE bool never_meet(std::uint32_t face_moving, std::uint32_t face_fixed, Vec3& axis) const {
    const Triangle own = moving.triangle(face_moving), other = fixed.triangle(face_fixed);
    const AxisCcdResult found = ccd_triangle_triangle({detail::moved(start, own), detail::moved(end, own)},
                                                      {other, other}, 0, axis, rules.limits);
    if (found.ccd.status != CcdStatus::Free) return false;
    axis = found.axis;
    return true;
  }

  DISMANTLE_HOST_DEVICE double min_gap(std::uint32_t face_moving, std::uint32_t face_fixed, Vec3 axis) const {
    const Triangle own = moving.triangle(face_moving), other = fixed.triangle(face_fixed);
    double low = std::numeric_limits<double>::infinity(), high = -low, reach = 0;
    for (int i = 0; i < 3; ++i) {
      const Vec3 t0 = start * own[i], t1 = end * own[i];
      low = detail::least(low, dot(axis, other[i]));
      high = detail::most(detail::most(high, dot(axis, t0)), dot(axis, t1));
      reach = detail::most(detail::most(detail::most(reach, max_abs(other[i])), max_abs(t0)), max_abs(t1));
    }
    // The axis is of unit length to a few u.
    return low - high - deviation - detail::kDotError * reach;
  }

  DISMANTLE_HOST_DEVICE static std::size_t gather(const SolidView& solid, std::uint32_t face,
                                                  Vec3 (&to)[Around::kMax]) {
    std::size_t count = 0;
    for (const std::uint32_t v : solid.faces[face].v) {
      const std::uint32_t begin = solid.around_begin[v], end = solid.around_begin[v + 1];
      const std::uint32_t stride = (end - begin + Around::kMaxOfCorner - 1) / Around::kMaxOfCorner;
      for (std::uint32_t k = begin; k < end; k += stride)
        if (solid.around[k] != face) to[count++] = solid.normals[solid.around[k]];
    }
    return count;
  }

  DISMANTLE_HOST_DEVICE bool still_parts(const TriangleMotion& motion, const Pair& pair, Vec3 axis) const {
    const Triangle &t0 = motion.t0, &t1 = motion.t1;
    const double size = length(axis);
    if (!(size > 0.5 && size < 2)) return false;
    double low = dot(axis, pair.fixed[0]), high = detail::most(dot(axis, t0[0]), dot(axis, t1[0])), reach = 0;
    for (int i = 0; i < 3; ++i) {
      low = detail::least(low, dot(axis, pair.fixed[i]));
      high = detail::most(detail::most(high, dot(axis, t0[i])), dot(axis, t1[i]));
      reach = detail::most(detail::most(detail::most(reach, max_abs(pair.fixed[i])), max_abs(t0[i])), max_abs(t1[i]));
    }
    // Two dot products of coordinates up to `reach`, each off by less than 8 u of three of them.
    const double gap = low - high - detail::kDotError * reach;
    double usable = allowed;
    if (rules.sides == SideRule::Normals) {
      usable = OutwardNormals{normal_unscaled(t0), normal_unscaled(pair.fixed), {}, {}}.allowance(axis, allowed);
      Around around;
      if (usable < allowed && gap < -usable) usable = normals_of(pair, start.rotation, around).allowance(axis, allowed);
    }
    return gap >= -usable * detail::least(1.0, size) * (1 - detail::kDotError);
  }

  /// An axis from the moving triangle to the fixed one, where each knows no side of the other: as they are apart, or as
  /// their normals say where they touch; zero where neither tells.
  DISMANTLE_HOST_DEVICE Vec3 side_of(const Triangle& own, const Triangle& other) const {
    const TriangleMotion now{own, own}, still{other, other};
    AxisCcdResult found = ccd_triangle_triangle(now, still, 0, Vec3{}, rules.limits);
    if (found.ccd.status == CcdStatus::Free) return found.axis;
    const OutwardNormals normals{normal_unscaled(own), normal_unscaled(other), {}, {}};
    found = ccd_triangle_triangle(now, still, allowed, Vec3{}, normals, rules.limits);
    return found.ccd.status == CcdStatus::Free ? found.axis : Vec3{};
  }

  DISMANTLE_HOST_DEVICE AxisCcdResult test_chords(const TriangleMotion& motion, const Pair& pair, Vec3 hint) const {
    const TriangleMotion still{pair.fixed, pair.fixed};
    if (rules.sides == SideRule::Memory) {
      if (length_squared(hint) == 0) hint = side_of(motion.t0, pair.fixed);
      AxisCcdResult found = ccd_triangle_triangle(motion, still, allowed, hint, rules.limits);
      // Stopped, the pair stays on the side that it was on: what the search ended on may be another.
      if (found.ccd.status == CcdStatus::Contact && still_parts({motion.t0, motion.t0}, pair, hint)) found.axis = hint;
      return found;
    }
    if (rules.sides == SideRule::Free) {
      const AxisCcdResult found = ccd_triangle_triangle(motion, still, allowed, hint, rules.limits);
      if (found.ccd.status == CcdStatus::Free || length_squared(hint) == 0) return found;
      // Bound to the side of the hint it was stopped: the least blocking axis may be on another.
      const AxisCcdResult unbound = ccd_triangle_triangle(motion, still, allowed, Vec3{}, rules.limits);
      return unbound.ccd.toi > found.ccd.toi ? unbound : found;
    }
    return test_facing(motion, pair, hint);
  }

  DISMANTLE_HOST_DEVICE AxisCcdResult test_facing(const TriangleMotion& motion, const Pair& pair, Vec3 hint) const {
    const TriangleMotion still{pair.fixed, pair.fixed};
    Around around;
    const OutwardNormals normals = normals_of(pair, start.rotation, around);
    AxisCcdResult found = ccd_triangle_triangle(motion, still, allowed, hint, normals, rules.limits);
    if (found.ccd.status == CcdStatus::Free) return found;
    // The axis that it ended on may be one that only held by chance: the response needs the one of the contact.
    detail::LeastBlockingAxis least(motion, pair.fixed, normals, allowed);
    least.consider_all(motion.t0);
    if (found.ccd.toi > 0) least.consider_all(detail::between(motion, found.ccd.toi));
    if (length_squared(least.axis()) > 0) found.axis = least.axis();
    if (found.ccd.toi > 0) return found;
    // Where no axis that the normals allow parts them to begin with (overlaps of tessellations), any other may.
    const TriangleMotion begin{motion.t0, motion.t0};
    if (ccd_triangle_triangle(begin, still, allowed, hint, normals, rules.limits).ccd.status == CcdStatus::Free)
      return found;
    return ccd_triangle_triangle(motion, still, allowed, Vec3{}, rules.limits);
  }
};

}  // namespace dismantle
