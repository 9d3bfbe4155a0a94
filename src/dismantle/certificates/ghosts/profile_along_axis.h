// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/ghosts/lower_envelope.h"
#include "dismantle/features/axis_frame.h"
#include "dismantle/geometry/triangle.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace dismantle {

/// The outline of faces seen along an axis: how near to the axis they come in each direction, or how far from it they
/// reach.
///
/// It is kept by sectors. There, a direction is given by the tangent of its angle from the middle of the sector, and an
/// outline by the inverse of its distance along the middle: edges are straight in these coordinates, too, so that the
/// outline is an envelope of segments.
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
  static constexpr std::size_t kSectors = 1024;
  /// A point across the axis.
  struct Across {
    double first, second;  // along AxisFrame::first and AxisFrame::second [mm]
  };
  /// The same in a sector.
  struct InSector {
    double ahead, aside;  // along the sector's middle, and a quarter turn from there [mm]
  };
  Across across(Vec3 v) const { return {dot(v, axis_.first), dot(v, axis_.second)}; }
  InSector in_sector(std::size_t sector, Across p) const {
    const Across& middle = middles_[sector];
    return {middle.first * p.first + middle.second * p.second, middle.first * p.second - middle.second * p.first};
  }
  static std::size_t sector_of(double angle);
  static double middle_of(std::size_t sector);
  template <class Visit>
  static void for_each_sector(double from, double to, const Visit& visit);
  std::optional<GraphSegment> seen_in(std::size_t sector, Across from, Across to) const;
  std::vector<GraphSegment> outline_of(std::vector<GraphSegment> seen) const;
  /// True if a distance lies beyond another one, as the outline has it.
  bool beyond(double a, double b) const { return farthest_ ? a > b : a < b; }

  AxisFrame axis_;
  bool farthest_;
  std::array<Across, kSectors> middles_;                      // unit
  std::array<std::vector<GraphSegment>, kSectors> outlines_;  // inverse distances; negative for the nearest outline
};

}  // namespace dismantle
