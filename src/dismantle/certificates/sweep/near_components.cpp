// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/sweep/near_components.h"

#include <cmath>

namespace dismantle {

namespace {

/// The tree is rebuilt when more components than this multiple of the square root of their number are outside it: that
/// balances the cost of rebuilding with that of testing those outside.
constexpr double kOutsideShare = 2;

}  // namespace

NearComponents::NearComponents(const BoundingSpheres& spheres)
    : spheres_(&spheres), poses_in_tree_(spheres.size()), placed_(spheres.size()) {
  at_.reserve(spheres.size());
  for (std::uint32_t c = 0; c < spheres.size(); ++c) at_.push_back(spheres.at(ComponentId(c), {}));
  tree_ = SphereTree(at_);
}

void NearComponents::place(ComponentId c, const Pose& pose) {
  at_[c.value] = spheres_->at(c, pose);
  std::uint32_t& place = placed_[c.value];
  const bool outside = !(pose == poses_in_tree_[c.value]);
  if (outside == (place != 0)) {
    if (outside) pose_outside_[place - 1] = pose;
    return;
  }
  if (outside) {
    outside_.push_back(c);
    pose_outside_.push_back(pose);
    place = static_cast<std::uint32_t>(outside_.size());
    return;
  }
  placed_[outside_.back().value] = place;
  outside_[place - 1] = outside_.back();
  pose_outside_[place - 1] = pose_outside_.back();
  outside_.pop_back();
  pose_outside_.pop_back();
  place = 0;
}

void NearComponents::rebuild_if_due() {
  if (static_cast<double>(outside_.size()) <= kOutsideShare * std::sqrt(static_cast<double>(at_.size()))) return;
  for (std::size_t i = 0; i < outside_.size(); ++i) {
    poses_in_tree_[outside_[i].value] = pose_outside_[i];
    placed_[outside_[i].value] = 0;
  }
  outside_.clear();
  pose_outside_.clear();
  tree_ = SphereTree(at_);
}

}  // namespace dismantle
