// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/vec3.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace dismantle {

/// A direction with a weight.
struct WeightedDirection {
  Vec3 direction;     ///< Unit.
  double weight = 0;  ///< As its source defines: often an area [mm^2].
};

/// Axis: a direction and its opposite are equal.
enum class Sense { Directed, Axis };

/// Clusters directions: those within about kSameDirectionAngle of each other are merged into their weighted mean.
class DirectionClusters {
 public:
  /// No directions yet.
  explicit DirectionClusters(Sense sense) : sense_(sense) {}

  /// Adds a direction. @pre direction is not zero
  void add(const Vec3& direction, double weight);
  /// True if no direction was added.
  bool empty() const { return cells_.empty(); }
  /// At most `count` clusters, by descending weight.
  std::vector<WeightedDirection> heaviest(std::size_t count) const;

 private:
  struct Cell {
    Vec3 sum;
    double weight = 0;
  };
  Sense sense_;
  std::map<std::array<std::int32_t, 3>, Cell> cells_;
};

/// Directions within this angle count as equal [rad].
inline constexpr double kSameDirectionAngle = 1e-3;

}  // namespace dismantle
