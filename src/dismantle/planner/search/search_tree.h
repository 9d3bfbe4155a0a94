// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/screw.h"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace dismantle {

/// Where a component has been.
struct Configuration {
  Pose pose;
  std::size_t from = 0;   ///< Index of the place that it came from; of the first one itself.
  std::vector<Pose> way;  ///< From there, this pose last.
};

/// The places that a search has been to, a tree that begins where the component was assembled.
class SearchTree {
 public:
  /// @param center, radius of the assembled component [mm]
  SearchTree(const Vec3& center, double radius) : center_(center), radius_(radius), configurations_(1) {}

  std::size_t size() const { return configurations_.size(); }
  const Configuration& operator[](std::size_t place) const { return configurations_[place]; }
  void add(Configuration place) { configurations_.push_back(std::move(place)); }

  /// Where the component's center is at a pose [mm].
  Vec3 center_at(const Pose& pose) const { return transform_from_pose(pose) * center_; }
  /// How far apart two poses are: what the center goes and what the rim turns [mm].
  double distance(const Pose& a, const Pose& b) const;
  /// The place nearest to a pose, and how far that is [mm].
  std::pair<std::size_t, double> nearest(const Pose& pose) const;
  /// How far the center has been from where it was assembled, in radii; nothing where there are no other places.
  std::optional<double> furthest() const;
  /// From where it was assembled to a place.
  std::vector<Pose> path_to(std::size_t place) const;

 private:
  Vec3 center_;
  double radius_;
  std::vector<Configuration> configurations_;
};

}  // namespace dismantle
