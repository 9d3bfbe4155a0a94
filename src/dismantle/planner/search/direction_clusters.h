// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/vec3.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace dismantle {

/// A unit direction and how much speaks for it.
struct WeightedDirection {
  Vec3 direction;
  double weight = 0;
};

/// Whether a direction and its opposite are the same.
enum class Sense { Directed, Axis };

/// Gathers directions: those within kSameDirectionAngle of each other, or a little more, become one, their weighted
/// mean.
class DirectionClusters {
 public:
  explicit DirectionClusters(Sense sense) : sense_(sense) {}

  /// @param direction of any length but zero
  void add(const Vec3& direction, double weight);
  bool empty() const { return cells_.empty(); }
  /// At most `count` of them, by falling weight.
  std::vector<WeightedDirection> heaviest(std::size_t count) const;

 private:
  struct Cell {
    Vec3 sum;
    double weight = 0;
  };
  Sense sense_;
  std::map<std::array<std::int32_t, 3>, Cell> cells_;
};

/// [rad]
inline constexpr double kSameDirectionAngle = 1e-3;

}  // namespace dismantle
