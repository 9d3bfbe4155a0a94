// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"

#include <optional>
#include <vector>

namespace dismantle {

/// The free distance of a set along one direction.
struct FreeDirection {
  Vec3 direction;          ///< Unit [world].
  bool free = false;       ///< The set can leave the assembly's bounding box.
  double distance = 0;     ///< Certified free distance [mm]; if free: until it is outside.
  ComponentId blocked_by;  ///< The first component that blocks; invalid if free.
};

/// Finds straight exit motions of the moving set of an engine.
class ExitSearch {
 public:
  /// @param set the moving set of `engine`, all at one pose; assembly and engine must outlive this
  ExitSearch(const Assembly& assembly, const CertificateEngine& engine, Span<const ComponentId> set);

  /// The bounding box of the set at its present pose [mm].
  const Aabb& box() const { return box_; }
  /// True if the set is outside the bounding box of the assembled assembly.
  bool is_outside() const;
  /// Distance along a unit direction after which the set is outside the bounding box of the assembled assembly, with a
  /// margin [mm].
  double exit_distance(const Vec3& direction) const;
  /// The free distance of the set along each unit direction.
  std::vector<FreeDirection> free_distances(Span<const Vec3> directions) const;
  /// Candidate directions: coordinate axes and the normals of contacts within `contact_reach` [mm]. Free ones first,
  /// then by descending distance; those along which the set can hardly move are left out.
  std::vector<FreeDirection> find(double contact_reach) const;
  /// Direction from the center of the assembly to that of the set; +z if they coincide.
  Vec3 outward() const;

 private:
  const Assembly& assembly_;
  const CertificateEngine& engine_;
  Pose pose_;
  Aabb all_, box_;
};

}  // namespace dismantle
