// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/span.h"
#include "dismantle/features/axis_frame.h"

#include <cstddef>
#include <vector>

namespace dismantle {

/// Where rays from an axis, in planes across it, cross the surface of a component. Decides by the parity of crossings
/// what is inside: meshes that are not closed give wrong answers near their gaps.
class AxialRays {
 public:
  /// Number of rays in each plane.
  static constexpr std::size_t kRays = 12;

  /// @param frame of the axis [assembly frame] @param positions of the planes along it, ascending [mm]
  AxialRays(const Component& component, const AxisFrame& frame, Span<const double> positions);

  /// True if no ray meets the component.
  bool empty() const { return distances_.empty(); }
  /// The median over the rays of a plane of the distance at which they leave the component for the last time [mm]; 0 if
  /// most do not meet it.
  double outer(std::size_t plane) const;
  /// The number of rays of a plane on which a point at a distance from the axis is inside the component.
  std::size_t inside_at(std::size_t plane, double distance) const;
  /// The number of rays of a plane that enter the component at most at a distance, or begin inside it and are still
  /// inside at `solid`.
  std::size_t surrounding(std::size_t plane, double distance, double solid) const;
  /// The median over the rays of a plane that enter the component of the distance at which they do so for the first
  /// time; 0 on rays that begin inside [mm].
  double hole(std::size_t plane) const;

 private:
  /// The distances of the crossings on a ray, ascending [mm].
  Span<const double> crossings(std::size_t plane, std::size_t ray) const;

  std::vector<double> distances_;   // by plane and ray
  std::vector<std::size_t> begin_;  // of each plane and ray in `distances_`, and the end
};

}  // namespace dismantle
