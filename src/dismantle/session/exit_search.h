// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"

#include <optional>
#include <vector>

namespace dismantle {

/// How far a set can go straight.
struct FreeDirection {
  Vec3 direction;          ///< Unit [world].
  bool free = false;       ///< All the way until the set is outside the assembly's box.
  double distance = 0;     ///< How far it certainly gets [mm]; where free: until it is outside.
  ComponentId blocked_by;  ///< Where not free.
};

/// The ways out of an assembly for a set that its engine has in hand.
class ExitSearch {
 public:
  /// @param set all at one pose, in hand of `engine`; both must outlive this
  ExitSearch(const Assembly& assembly, const CertificateEngine& engine, Span<const ComponentId> set);

  /// The box around the set where it is [mm].
  const Aabb& box() const { return box_; }
  bool is_outside() const;
  /// How far the set has to go along a unit direction until it is outside the assembled assembly's box, with a margin
  /// [mm].
  double exit_distance(const Vec3& direction) const;
  /// How far the set can go along each direction.
  std::vector<FreeDirection> look(Span<const Vec3> directions) const;
  /// The axes' directions and the normals of what the set touches, free ones first, then the furthest first; those
  /// that lead nowhere are left out.
  std::vector<FreeDirection> find(double contact_reach) const;
  /// From the assembly's middle to the set's; up where they are the same.
  Vec3 outward() const;

 private:
  const Assembly& assembly_;
  const CertificateEngine& engine_;
  Pose pose_;
  Aabb all_, box_;
};

}  // namespace dismantle
