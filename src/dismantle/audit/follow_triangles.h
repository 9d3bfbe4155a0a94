// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/sweep_triangles.h"
#include "dismantle/audit/triangle_axes.h"

#include <cstdint>
#include <vector>

namespace dismantle::audit {

/// A triangle of b at an instant, as a sees it, and how its corners move.
struct MovingTriangle;

/// One direction that allows two triangles to go on, and for how long.
struct PairCertificate {
  AxisGap axis;
  double time = -1;
};

/// A stretch of one screw, and where b is when it starts.
struct ScrewStretch {
  std::uint32_t segment = 0;
  double from = 0, to = 1;  ///< Of the segment.
  RigidTransform a_from_b;  ///< At `from`.
};

/// Follows pairs of triangles of a sweep through time, and keeps what it finds: what every way to say which triangles
/// come near each other, and when, ends in.
class TriangleFollower {
 public:
  explicit TriangleFollower(const PairSweep& pair);

  /// Whether some of these segments still has to be looked at: none before the first active one, nor behind the one
  /// with the first breach.
  bool looks_at(std::uint32_t first, std::uint32_t count) const {
    return first + count > pair_.first_active && first < end_;
  }
  /// Follows a triangle pair through a stretch. @param axis a direction to try first, zero for none
  /// @return the direction that held last
  Vec3 follow(const ScrewStretch& stretch, std::uint32_t face_a, std::uint32_t face_b, Vec3 axis);
  /// What was found, to be asked for once, last.
  TriangleFindings take();

 private:
  double limit() const { return pair_.allowed * (1 + 1e-9) + pair_.rounding; }
  /// The direction along which the pair may go on longest; where none may, the one of the exact depth.
  PairCertificate certificate(const Triangle& a, const MovingTriangle& moving, double horizon, Vec3 first);
  /// Marks the vertices that may touch the other triangle within the stretch: those that neither the axis keeps off it,
  /// nor its plane or those across its edges. @param moving b at its start
  void mark_crossing(const ScrewStretch& stretch, std::uint32_t face_a, std::uint32_t face_b, const Triangle& a,
                     const MovingTriangle& moving, Vec3 axis);
  void mark_all(std::uint32_t segment, std::uint32_t face_a, std::uint32_t face_b);
  void mark(int side, std::uint32_t vertex, const ScrewStretch& when);

  const PairSweep& pair_;
  std::uint32_t end_ = 0xffffffffu;  // segments from here on are not looked at
  TriangleFindings findings_;
  bool may_enter_[2];                   // whether vertices of a, of b can get inside the other
  std::size_t room_[2] = {4096, 4096};  // so many crossings are kept before they are united
};

/// A triangle of a body where a transform takes it.
inline Triangle transformed(const RigidTransform& transform, const Triangle& t) {
  return {{transform * t[0], transform * t[1], transform * t[2]}};
}

}  // namespace dismantle::audit
