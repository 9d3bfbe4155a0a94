// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/search_tree.h"

#include <algorithm>
#include <limits>

namespace dismantle {

double SearchTree::distance(const Pose& a, const Pose& b) const {
  return length(center_at(a) - center_at(b)) + radius_ * screw_between(a, b).angle;
}

std::pair<std::size_t, double> SearchTree::nearest(const Pose& pose) const {
  std::pair<std::size_t, double> best{0, std::numeric_limits<double>::infinity()};
  const Vec3 center = center_at(pose);
  for (std::size_t k = 0; k < configurations_.size(); ++k) {
    // The rotation is expensive to compute; the centers alone often decide.
    if (length(center_at(configurations_[k].pose) - center) >= best.second) continue;
    const double apart = distance(configurations_[k].pose, pose);
    if (apart < best.second) best = {k, apart};
  }
  return best;
}

std::optional<double> SearchTree::furthest() const {
  if (configurations_.size() == 1) return std::nullopt;
  double most = 0;
  for (const Configuration& node : configurations_) most = std::max(most, length(center_at(node.pose) - center_));
  return most / radius_;
}

std::vector<Pose> SearchTree::path_to(std::size_t index) const {
  std::vector<std::size_t> back;
  for (std::size_t k = index; k != 0; k = configurations_[k].from) back.push_back(k);
  std::vector<Pose> whole;
  for (auto k = back.rbegin(); k != back.rend(); ++k)
    whole.insert(whole.end(), configurations_[*k].poses.begin(), configurations_[*k].poses.end());
  return whole;
}

}  // namespace dismantle
