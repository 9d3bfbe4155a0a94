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

/// View of the triangles of a SolidTree in the memory of the host or of a device.
struct SolidView {
  const Vec3* vertices = nullptr;               ///< As SolidTree::vertices.
  const Face* faces = nullptr;                  ///< As SolidTree::faces.
  const Vec3* normals = nullptr;                ///< As SolidTree::normals; this and the next two may be null.
  const std::uint32_t* around_begin = nullptr;  ///< As SolidTree::around_begin.
  const std::uint32_t* around = nullptr;        ///< As SolidTree::around.

  /// The triangle of a face [mm, assembled].
  DISMANTLE_HOST_DEVICE Triangle triangle(std::uint32_t face) const {
    const Face& f = faces[face];
    return {{vertices[f.v[0]], vertices[f.v[1]], vertices[f.v[2]]}};
  }
};

/// Result of a triangle-pair test.
struct TrianglePairResult {
  /// The state in which the test ended.
  struct Contact {
    std::uint32_t face_moving = 0;  ///< Face of the moving component.
    std::uint32_t face_fixed = 0;   ///< Face of the fixed component.
    double toi = 0;                 ///< The two are certainly apart on [0, toi].
    /// Unit, from the moving to the fixed triangle [frame of the fixed component]; zero if no axis separates them.
    Vec3 axis;
  };

  bool free = true;  ///< The two are certainly apart during the whole motion.
  double gap = 0;    ///< Lower bound of their distance during the whole motion, along the axis [mm].
  Contact contact;   ///< The axis is set even if free.
};

namespace detail {

/// Bound of the rounding of a gap of two projections, relative to the largest coordinate.
inline constexpr double kDotError = 0x1p-46;

/// The triangle moved by a rigid transform.
DISMANTLE_HOST_DEVICE inline Triangle moved(const RigidTransform& t, const Triangle& triangle) {
  return {{t * triangle[0], t * triangle[1], t * triangle[2]}};
}

/// The triangle at time `t` of a linear motion.
DISMANTLE_HOST_DEVICE inline Triangle between(const TriangleMotion& motion, double t) {
  Triangle now;
  for (int i = 0; i < 3; ++i) now[i] = (1 - t) * motion.t0[i] + t * motion.t1[i];
  return now;
}

/// The vector scaled to unit length; zero if it is zero or not finite.
DISMANTLE_HOST_DEVICE inline Vec3 unit_or_zero(Vec3 axis) {
  const double size = max_abs(axis);
  return size > 0 && size < std::numeric_limits<double>::infinity() ? normalized(axis / size) : Vec3{};
}

/// The outward normals of two faces of closed solids and of the faces around them. A contact pushes the two apart along
/// an axis that leaves the one and enters the other through their outsides; along any other axis, such as one between
/// two faces of a flat wall, it would stop motions that slide along the wall.
struct OutwardNormals {
  ///@{ Outward normals of the two faces, of any length; zero allows every axis.
  Vec3 a, b;
  ///@}
  ///@{ Unit outward normals of the faces at the corners of each.
  Span<const Vec3> around_a, around_b;
  ///@}

  /// Smallest cosine at which an axis agrees with a face's normal: below 0, for faces that turn during the motion or
  /// are seen edge-on.
  static constexpr double kMinCosine = -0.05;
  /// Smallest cosine at which an axis agrees with the normal of a neighbouring face.
  static constexpr double kMinCosineAround = 0.3;

  /// True if the axis w, from A to B, agrees with the normal of A or of a face around A, and -w with that of B or of a
  /// face around B.
  DISMANTLE_HOST_DEVICE bool allow(Vec3 w) const { return ahead(w, a, around_a) && ahead(-w, b, around_b); }

 private:
  DISMANTLE_HOST_DEVICE static bool ahead(Vec3 w, Vec3 normal, Span<const Vec3> around) {
    const double along = dot(w, normal), square = length_squared(w);
    if (along >= 0 || along * along <= square * (kMinCosine * kMinCosine) * length_squared(normal)) return true;
    for (const Vec3& n : around) {
      const double cosine = dot(w, n);
      if (cosine > 0 && cosine * cosine > square * (kMinCosineAround * kMinCosineAround)) return true;
    }
    return false;
  }
};

/// Search for the axis of a contact: of the axes that the normals allow, the one along which the motion goes furthest
/// before the allowance is used up; if it is used up at the start along all of them, the one of the smallest depth.
class LeastBlockingAxis {
 public:
  /// @param allowed penetration depth [mm]
  DISMANTLE_HOST_DEVICE LeastBlockingAxis(const TriangleMotion& moving, const Triangle& fixed,
                                          const OutwardNormals& normals, double allowed)
      : moving_(moving), fixed_(fixed), normals_(normals), allowed_(allowed) {}

  /// Considers the 17 axes of the two triangles at some time.
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

  /// The best axis so far, unit; zero if the normals allow none.
  DISMANTLE_HOST_DEVICE Vec3 axis() const { return axis_; }

 private:
  DISMANTLE_HOST_DEVICE void consider(Vec3 line) {
    const double size = length(line);
    if (!(size > 0)) return;
    const Vec3 w = line / size;
    const Extent fixed = extent(w, fixed_), t0 = extent(w, moving_.t0), t1 = extent(w, moving_.t1);
    consider(w, fixed.low - t0.high, fixed.low - t1.high);
    consider(-w, t0.low - fixed.high, t1.low - fixed.high);
  }

  /// Considers a unit vector from the moving to the fixed triangle. @param gap_t0, gap_t1 along it [mm]
  DISMANTLE_HOST_DEVICE void consider(Vec3 w, double gap_t0, double gap_t1) {
    // Without an allowance, an axis along which the two do not approach each other is none of a contact.
    if (allowed_ == 0 && !(gap_t1 < gap_t0)) return;
    double reach = gap_t0 + allowed_;  // negative: the allowance is used up at the start
    if (reach >= 0) reach = gap_t1 >= -allowed_ ? 1 + gap_t1 + allowed_ : reach / (gap_t0 - gap_t1);
    if (reach <= furthest_ || !normals_.allow(w)) return;
    furthest_ = reach;
    axis_ = w;
  }

  /// The interval of a triangle along an axis, from the first corner of the fixed one [mm].
  struct Extent {
    double low, high;
  };
  DISMANTLE_HOST_DEVICE Extent extent(Vec3 w, const Triangle& t) const {
    const Vec3 origin = fixed_[0];
    const double x = dot(w, t[0] - origin), y = dot(w, t[1] - origin), z = dot(w, t[2] - origin);
    return {min(z, min(y, x)), max(z, max(y, x))};
  }

  const TriangleMotion& moving_;
  const Triangle& fixed_;
  const OutwardNormals& normals_;
  double allowed_;
  double furthest_ = -std::numeric_limits<double>::infinity();
  Vec3 axis_;
};

}  // namespace detail

/// The triangle-pair test of a TrianglePairSweep: the same code on the CPU and on CUDA.
struct TrianglePairSweepKernel {
  SolidView moving;          ///< The moving solid, in the memory of the processor that runs the test.
  SolidView fixed;           ///< The fixed solid.
  RigidTransform start;      ///< Of the moving component at the start, in the fixed one's frame.
  RigidTransform end;        ///< The same at the end.
  Mat3 middle;               ///< The rotation half way.
  double deviation = 0;      ///< Bound of the distance between arcs and chords [mm].
  AdvancementLimits limits;  ///< Of the conservative advancement.

  /// Two faces and their triangles at the start of the motion.
  struct Pair {
    std::uint32_t face_moving;  ///< Face of the moving component.
    std::uint32_t face_fixed;   ///< Face of the fixed component.
    Triangle moving;            ///< [mm, frame of the fixed component]
    Triangle fixed;             ///< [mm]
  };
  /// Room for the normals of the faces around two faces; an even sample of the faces at a corner that has many.
  struct Around {
    static constexpr std::uint32_t kMaxOfCorner = 8;       ///< Normals of a corner.
    static constexpr std::size_t kMax = 3 * kMaxOfCorner;  ///< Normals of a face.
    Vec3 moving[kMax];                                     ///< Around the moving face.
    Vec3 fixed[kMax];                                      ///< Around the fixed face.
  };

  /// As TrianglePairSweep::test().
  DISMANTLE_HOST_DEVICE TrianglePairResult test(std::uint32_t face_moving, std::uint32_t face_fixed, Vec3 hint,
                                                double horizon) const {
    TrianglePairResult result;
    result.contact = {face_moving, face_fixed, 1, hint};
    const Triangle own = moving.triangle(face_moving);
    const Pair pair{face_moving, face_fixed, detail::moved(start, own), fixed.triangle(face_fixed)};
    TriangleMotion motion{pair.moving, detail::moved(end, own)};
    if (!still_separates(motion, pair, hint)) {
      if (horizon < 1) motion.t1 = detail::between(motion, horizon);
      const AxisCcdResult found = test_chords(motion, pair, hint);
      result.free = found.ccd.status == CcdStatus::Free;
      result.contact.axis = found.axis;
      if (!result.free) result.contact.toi = horizon * found.ccd.toi;
    }
    result.contact.axis = detail::unit_or_zero(result.contact.axis);
    result.gap = min_gap(face_moving, face_fixed, result.contact.axis);
    return result;
  }

 private:
  /// Lower bound of the gap of two faces along a unit axis during the motion [mm].
  DISMANTLE_HOST_DEVICE double min_gap(std::uint32_t face_moving, std::uint32_t face_fixed, Vec3 axis) const {
    const Triangle own = moving.triangle(face_moving), other = fixed.triangle(face_fixed);
    double low = std::numeric_limits<double>::infinity(), high = -low, reach = 0;
    for (int i = 0; i < 3; ++i) {
      const Vec3 t0 = start * own[i], t1 = end * own[i];
      low = min(dot(axis, other[i]), low);
      high = max(dot(axis, t1), max(dot(axis, t0), high));
      reach = max(max_abs(t1), max(max_abs(t0), max(max_abs(other[i]), reach)));
    }
    // The axis is of unit length to a few u.
    return low - high - deviation - detail::kDotError * reach;
  }

  /// Collects the normals around a face. @return their number
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

  /// True if the axis certainly separates the two during the motion.
  DISMANTLE_HOST_DEVICE bool still_separates(const TriangleMotion& motion, const Pair& pair, Vec3 axis) const {
    const Triangle &t0 = motion.t0, &t1 = motion.t1;
    const double size = length(axis);
    if (!(size > 0.5 && size < 2)) return false;
    double low = dot(axis, pair.fixed[0]), high = max(dot(axis, t1[0]), dot(axis, t0[0])), reach = 0;
    for (int i = 0; i < 3; ++i) {
      low = min(dot(axis, pair.fixed[i]), low);
      high = max(dot(axis, t1[i]), max(dot(axis, t0[i]), high));
      reach = max(max_abs(t1[i]), max(max_abs(t0[i]), max(max_abs(pair.fixed[i]), reach)));
    }
    // Two dot products of coordinates up to `reach`, each off by less than 8 u of three of them.
    const double gap = low - high - detail::kDotError * reach;
    return gap >= 0;
  }

  /// The outward normals around both faces, the moving one's turned by `rotation`; none that restrict an axis unless
  /// both components have an outside. @param around storage of the result
  DISMANTLE_HOST_DEVICE detail::OutwardNormals normals_of(const Pair& pair, const Mat3& rotation,
                                                          Around& around) const {
    if (!moving.around_begin || !fixed.around_begin) return {};
    const std::size_t count_moving = gather(moving, pair.face_moving, around.moving);
    const std::size_t count_fixed = gather(fixed, pair.face_fixed, around.fixed);
    for (std::size_t k = 0; k < count_moving; ++k) around.moving[k] = rotation * around.moving[k];
    return {normal_unscaled(pair.moving),
            normal_unscaled(pair.fixed),
            {around.moving, count_moving},
            {around.fixed, count_fixed}};
  }

  /// Tests two triangles whose corners move linearly.
  DISMANTLE_HOST_DEVICE AxisCcdResult test_chords(const TriangleMotion& motion, const Pair& pair, Vec3 hint) const {
    const TriangleMotion still{pair.fixed, pair.fixed};
    AxisCcdResult found = ccd_triangle_triangle(motion, still, 0, hint, limits);
    if (found.ccd.status == CcdStatus::Free) return found;
    // The axis that the search ended with may separate them only by chance: the response needs that of the contact.
    Around around;
    for (const bool any : {false, true}) {
      const detail::OutwardNormals normals = any ? detail::OutwardNormals{} : normals_of(pair, start.rotation, around);
      detail::LeastBlockingAxis search(motion, pair.fixed, normals, 0);
      search.consider_all(motion.t0);
      if (found.ccd.toi > 0) search.consider_all(detail::between(motion, found.ccd.toi));
      if (length_squared(search.axis()) == 0) continue;
      found.axis = search.axis();
      break;
    }
    return found;
  }
};

}  // namespace dismantle
