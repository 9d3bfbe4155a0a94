// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/audit_body.h"

#include <vector>

namespace dismantle::audit {

/// A plane that a ghost does not cross.
struct GhostPlane {
  Vec3 normal;        ///< Unit normal, towards the ghost.
  double offset = 0;  ///< It stays where dot(normal, x) is at least this [mm].
};

/// A point that follows another one but never crosses a surface: the proxy of haptic rendering (Zilles and Salisbury,
/// "A constraint-based god-object method", 1995). It is a witness: while it is within a distance of the point that it
/// follows, that point has gone no further than this through the surface.
class GhostPoint {
 public:
  /// @param surface must outlive this @param standoff distance that it keeps from the surface [mm]
  GhostPoint(const AuditBody& surface, double standoff, Vec3 position)
      : surface_(&surface), standoff_(standoff), position_(position) {}

  /// Where it is [mm, frame of the surface].
  Vec3 position() const { return position_; }
  /// Moves along a straight line, if the surface is not in the way.
  bool shift(Vec3 displacement);
  /// Moves towards a point, along the surface where that is in the way.
  void approach(Vec3 target);

 private:
  /// The first face in the way.
  struct Hit {
    double part = 2;  // of the way; above 1 for none
    GhostPlane plane;
  };
  Hit first_hit(Vec3 to) const;
  void test_face(std::uint32_t face, Vec3 to, Hit& first) const;

  const AuditBody* surface_;
  double standoff_;
  Vec3 position_;
};

/// The point that is closest to `target` on the right sides of the planes; `fallback` where there is none.
Vec3 closest_allowed(const std::vector<GhostPlane>& planes, Vec3 target, Vec3 fallback);

}  // namespace dismantle::audit
