// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/audit_body.h"
#include "dismantle/audit/solid/open_boundary.h"

#include <optional>
#include <vector>

namespace dismantle::audit {

/// A component for the audit of solids: its surface, and what is inside it by winding number, so that cracked, open and
/// inside-out meshes have an inside too.
class SolidBody {
 public:
  /// A mesh that is not closed counts as a solid where its faces are, on average, at least this much inside and
  /// outside: halfway between both sides, the winding number of a closed surface is 1/2, that of a flat sheet 0. A box
  /// without a lid has 0.40, a hemisphere 0.31.
  static constexpr double kMinSolidity = 0.375;

  /// Depends on the component alone.
  explicit SolidBody(const Component& component);

  /// The surface and its tree of boxes.
  const AuditBody& surface() const { return surface_; }
  /// True if the component has an inside; else it is a sheet, which bounds no volume.
  bool solid() const { return solid_; }
  /// True if the surface is closed up to cracks: the winding number is whole then, and changes across the surface only.
  bool closed() const { return open_edges_.empty(); }
  /// 1 where the faces' normals point out of the component, -1 where they point into it.
  double orientation() const { return orientation_; }
  /// The boundary of the surface; empty where it is closed.
  const std::vector<OpenEdge>& open_edges() const { return open_edges_; }

  /// The winding number of the surface about a point [body frame]; undefined on the surface.
  double winding(Vec3 point) const;
  /// The last point whose winding number was asked for, which that of the next one can start from.
  struct LastPoint {
    Vec3 point;                       ///< [body frame]
    std::optional<int> winding = {};  ///< Nothing at first.
  };
  /// True if the point is inside: the magnitude of the winding number is more than 1/2. False for sheets.
  /// @param last kept from query to query, of points that are near each other
  bool inside(Vec3 point, LastPoint& last) const;
  /// As inside(point, last), for a point that is not near others.
  bool inside(Vec3 point) const {
    LastPoint none;
    return inside(point, none);
  }
  /// True if no point within `radius` of `point` that can be reached from it without crossing the surface is inside.
  /// @param gap a distance from the surface that none of these points falls below [mm]
  bool outside_throughout(Vec3 point, double radius, double gap, LastPoint& last) const;

 private:
  double winding_by_ray(Vec3 point, int direction) const;
  double solidity() const;

  AuditBody surface_;
  std::vector<OpenEdge> open_edges_;
  double orientation_ = 1;
  bool solid_ = false;
};

}  // namespace dismantle::audit
