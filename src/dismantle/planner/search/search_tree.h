// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/screw.h"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace dismantle {

/// A configuration that a component has reached.
struct Configuration {
  Pose pose;                ///< Of the component.
  std::size_t from = 0;     ///< Index of its parent; the root's is its own.
  std::vector<Pose> poses;  ///< The edge from the parent, one screw motion each; ends with `pose`.
};

/// The tree of configurations that a search has reached; its root is the assembled pose.
class SearchTree {
 public:
  /// @param center, radius of the assembled component [mm]
  SearchTree(const Vec3& center, double radius) : center_(center), radius_(radius), configurations_(1) {}

  /// Number of configurations.
  std::size_t size() const { return configurations_.size(); }
  /// The configuration with that index.
  const Configuration& operator[](std::size_t index) const { return configurations_[index]; }
  /// Adds a configuration.
  void add(Configuration configuration) { configurations_.push_back(std::move(configuration)); }

  /// The component's center at a pose [mm].
  Vec3 center_at(const Pose& pose) const { return transform_from_pose(pose) * center_; }
  /// Distance of two poses: displacement of the center plus rotation times the radius [mm].
  double distance(const Pose& a, const Pose& b) const;
  /// The index of the configuration nearest to a pose, and its distance [mm].
  std::pair<std::size_t, double> nearest(const Pose& pose) const;
  /// Largest displacement of the center, in radii; none if there is only the root.
  std::optional<double> furthest() const;
  /// The path from the root to a configuration.
  std::vector<Pose> path_to(std::size_t index) const;

 private:
  Vec3 center_;
  double radius_;
  std::vector<Configuration> configurations_;
};

}  // namespace dismantle
