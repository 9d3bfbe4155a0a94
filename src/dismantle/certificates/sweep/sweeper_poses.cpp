// SPDX-License-Identifier: Apache-2.0
// The poses of components, the moving set, and what is near it.
#include "dismantle/certificates/sweep/certificate_sweeper.h"
#include "dismantle/core/contract.h"

#include <algorithm>

namespace dismantle {

void CertificateSweeper::grab(Span<const ComponentId> components) {
  DISMANTLE_EXPECT(!components.empty());
  moving_.assign(components.begin(), components.end());
  std::sort(moving_.begin(), moving_.end());
  std::fill(is_moving_.begin(), is_moving_.end(), false);
  Aabb box;
  for (const ComponentId c : moving_) {
    DISMANTLE_EXPECT(poses_[c.value] == pose());
    is_moving_[c.value] = true;
    box.extend(assembled_bounds(surfaces()->assembly()[c]));
  }
  center_ = box.empty() ? Vec3{} : box.center();
  radius_ = 0;
  for (const ComponentId c : moving_)
    for (const Vec3& p : solid(c).vertices) radius_ = std::max(radius_, length(p - center_));
}

void CertificateSweeper::place(ComponentId c, const Pose& pose) {
  poses_[c.value] = pose;
  near_.place(c, pose);
  mark_changed(c);
}

void CertificateSweeper::move_to(const Pose& pose) {
  for (const ComponentId c : moving_) place(c, pose);
}

void CertificateSweeper::return_to(const Pose& pose) {
  move_to(pose);
  find_parted();
}

void CertificateSweeper::jump(Span<const Pose> poses) {
  DISMANTLE_EXPECT(poses.size() == poses_.size());
  const auto moved = [&](ComponentId c) { return !(poses[c.value] == poses_[c.value]); };
  if (std::any_of(moving_.begin(), moving_.end(), moved)) {
    moving_.clear();
    std::fill(is_moving_.begin(), is_moving_.end(), false);
  }
  for (std::uint32_t c = 0; c < poses.size(); ++c)
    if (moved(ComponentId(c))) place(ComponentId(c), poses[c]);
  near_.rebuild_if_due();
  known_depth_.clear();  // what follows depends on the poses alone
  find_parted();
}

std::vector<ComponentId> CertificateSweeper::near_straight(const Vec3& displacement) const {
  std::vector<ComponentId> near;
  const RigidTransform from = transform_from_pose(pose()),
                       to = transform_from_pose({pose().position + displacement, pose().rotation});
  for (const ComponentId moving : moving_)
    near_.for_each(
        store_.spheres().swept(moving, from, to, 0), [] { return 0.0; },
        [&](ComponentId fixed, double gap) {
          if (gap <= 0 && !is_moving_[fixed.value]) near.push_back(fixed);
        });
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  return near;
}

}  // namespace dismantle
