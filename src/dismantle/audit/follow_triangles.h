// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/sweep_triangles.h"
#include "dismantle/audit/triangle_axes.h"

#include <cstdint>
#include <vector>

namespace dismantle::audit {

/// A triangle of b at a time, in the frame of a, with the motion of its corners.
struct MovingTriangle;

/// An axis that certifies that the depth of two triangles remains allowed.
struct PairCertificate {
  AxisGap axis;      ///< The axis and the gap along it.
  double time = -1;  ///< Its duration, in units of the segment; negative for none.
};

/// A time interval of one segment.
struct ScrewStretch {
  std::uint32_t segment = 0;  ///< Index of the segment.
  double from = 0;            ///< Begin, in [0, 1] of the segment.
  double to = 1;              ///< End, in [0, 1] of the segment.
  RigidTransform a_from_b;    ///< The pose of b at `from`.
};

/// Follows triangle pairs of a sweep through time and collects the findings. Both broad phases (sweep_triangles(),
/// sweep_helix()) end in it.
class TriangleFollower {
 public:
  /// @param pair must outlive this
  explicit TriangleFollower(const PairSweep& pair);

  /// True if one of these segments has to be checked: not those before the first active one or after the one with the
  /// first breach.
  bool is_active(std::uint32_t first, std::uint32_t count) const {
    return first + count > pair_.first_active && first < end_;
  }
  /// Follows a triangle pair through a time interval. @param axis an axis to try first; zero for none
  /// @return the last certified axis
  Vec3 follow(const ScrewStretch& stretch, std::uint32_t face_a, std::uint32_t face_b, Vec3 axis);
  /// Returns the findings; to be called once, at the end.
  TriangleFindings take();

 private:
  double limit() const { return pair_.allowed * (1 + 1e-9) + pair_.rounding; }
  /// The axis with the longest certificate; where no axis has one, that of the exact depth.
  PairCertificate certificate(const Triangle& a, const MovingTriangle& moving, double horizon, Vec3 first);
  /// Marks the vertices that may touch the other triangle within the interval: those that neither the axis separates
  /// from it, nor its plane, nor the planes through its edges perpendicular to it. @param moving b at the begin
  void mark_crossing(const ScrewStretch& stretch, std::uint32_t face_a, std::uint32_t face_b, const Triangle& a,
                     const MovingTriangle& moving, Vec3 axis);
  void mark_all(std::uint32_t segment, std::uint32_t face_a, std::uint32_t face_b);
  void mark(int side, std::uint32_t vertex, const ScrewStretch& when);

  const PairSweep& pair_;
  std::uint32_t end_ = 0xffffffffu;  // segments from here on are not checked
  TriangleFindings findings_;
  bool may_enter_[2];                       // vertices of a, of b can be inside the other
  std::size_t capacity_[2] = {4096, 4096};  // number of crossings at which they are merged
};

/// A triangle, transformed.
inline Triangle transformed(const RigidTransform& transform, const Triangle& t) {
  return {{transform * t[0], transform * t[1], transform * t[2]}};
}

}  // namespace dismantle::audit
