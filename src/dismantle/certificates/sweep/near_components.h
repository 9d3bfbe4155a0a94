// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/sweep/bounding_spheres.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dismantle {

/// The bounding spheres of components at their present poses, in a tree, so that those near a motion are found without
/// testing all of them.
class NearComponents {
 public:
  /// All components in the assembled state. @param spheres must outlive this
  explicit NearComponents(const BoundingSpheres& spheres);

  /// Puts a component at a pose.
  void place(ComponentId c, const Pose& pose);
  /// Rebuilds the tree if many components were placed elsewhere since it was built.
  void rebuild_if_due();

  /// Calls visit(component, gap) for the components whose gap (SweptSphere::gap) from a moving sphere is at most
  /// `limit()`, and for some others, in no particular order. @param limit () -> double; `visit` may lower it
  template <class Limit, class Visit>
  void for_each(const SweptSphere& moving, const Limit& limit, const Visit& visit) const {
    const auto look_at = [&](std::uint32_t c) {
      if (!placed_[c]) visit(ComponentId(c), moving.gap(at_[c]));
    };
    tree_.traverse([&](const BoundingSphere& s) { return moving.gap_to_any(s); }, limit, look_at);
    for (const ComponentId c : outside_) visit(c, moving.gap(at_[c.value]));
  }

 private:
  const BoundingSpheres* spheres_;
  std::vector<BoundingSphere> at_;   ///< Of each component, at its pose.
  std::vector<Pose> poses_in_tree_;  ///< Of each component.
  SphereTree tree_;
  std::vector<ComponentId> outside_;   ///< Those that are not where the tree has them.
  std::vector<Pose> pose_outside_;     ///< Of each of these.
  std::vector<std::uint32_t> placed_;  ///< One more than the place of each component in `outside_`; 0: in the tree.
};

}  // namespace dismantle
