// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/features/axis_frame.h"
#include "dismantle/geometry/triangle_mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dismantle {

/// Number of rays around the axis of a section.
inline constexpr std::size_t kSectionRays = 72;

/// The section of a mesh by a plane across an axis, along rays from the axis.
struct AxialSection {
  double along = 0;                          ///< Position of the plane along the axis [mm].
  std::array<double, kSectionRays> outer{};  ///< Of each ray: where it leaves the solid for the last time; 0 if it
                                             ///< does not meet it [mm].
  std::array<double, kSectionRays> hole{};   ///< Of each ray: where it enters the solid; 0 if the axis is inside, or
                                             ///< the ray does not meet the solid [mm].
  std::array<std::uint8_t, kSectionRays> hits{};  ///< Of each ray: number of crossings of the surface.

  double outer_max() const;    ///< Largest of `outer` [mm].
  double outer_min() const;    ///< Smallest of `outer` [mm].
  double hole_max() const;     ///< Largest of `hole` [mm].
  double hole_min() const;     ///< Smallest of `hole` [mm].
  std::size_t misses() const;  ///< Number of rays that meet nothing.
  bool axis_is_empty() const;  ///< True if the axis is outside the solid by most rays.
};

/// Sections of a mesh at evenly spaced planes across an axis, in ascending order.
/// @param count number of sections, at least 2
std::vector<AxialSection> axial_sections(const TriangleMesh& mesh, const AxisFrame& frame, std::size_t count);

/// How strongly a radius varies `order` times per turn: the amplitude of that Fourier component relative to the mean.
double lobe_amplitude(const std::array<double, kSectionRays>& radii, int order);

/// An axis about which a mesh may be a fastener, and the extent of the mesh along and about it.
struct FastenerAxis {
  AxisFrame frame;                               ///< `along` is 0 in the middle of the mesh.
  double begin = 0;                              ///< Smallest position along the axis of a vertex [mm].
  double end = 0;                                ///< Largest position along the axis of a vertex [mm].
  double radius = 0;                             ///< Largest distance of a vertex from the axis [mm].
  double length() const { return end - begin; }  ///< Along the axis [mm].
};

/// The axes about which a mesh may be a fastener, the most symmetrical first: through its middle, with an outline that
/// is round or that a sixth of a turn takes to itself. Empty for other meshes.
std::vector<FastenerAxis> fastener_axes(const TriangleMesh& mesh);

}  // namespace dismantle
