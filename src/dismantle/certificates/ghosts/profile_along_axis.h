// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/features/axis_frame.h"
#include "dismantle/geometry/triangle.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace dismantle {

/// The outline of faces seen along an axis: how near to the axis they come in each direction, or how far from it they
/// reach.
class ProfileAlongAxis {
 public:
  /// @param faces to be seen @param farthest how far they reach; false: how near they come
  ProfileAlongAxis(const AxisFrame& axis, const std::vector<Triangle>& faces, bool farthest);

  /// The outline's distance from the axis at an angle of AxisFrame [mm]; nothing where there are no faces.
  std::optional<double> distance(double angle) const;

  /// The ratio of the outline's distance from the axis to that of a segment, where it is largest, or smallest for the
  /// nearest outline: at the ends of the segment, or at a corner of the outline in between. 1 where there are no faces.
  /// @param a, b its ends as AxisFrame::across() gives them, less than half a turn apart
  double ratio_to_segment(Vec3 a, Vec3 b) const;

 private:
  static constexpr std::size_t kBins = 1024;
  struct Edge {
    Vec3 from, along;  // across the axis
  };
  struct Corner {
    double angle, distance;
  };
  static std::size_t bin_of(double angle);
  template <class Visit>
  static void for_each_bin(double from, double to, const Visit& visit);
  /// True if a distance lies beyond another one, as the outline has it.
  bool beyond(double a, double b) const { return farthest_ ? a > b : a < b; }

  AxisFrame axis_;
  bool farthest_;
  std::vector<Edge> edges_;
  std::array<std::vector<std::uint32_t>, kBins> edges_in_;  // by angle
  std::array<std::vector<Corner>, kBins> corners_in_;       // of the outline, by angle
};

}  // namespace dismantle
