// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/surface/solid_tree.h"

#include <limits>
#include <optional>
#include <vector>

namespace dismantle {

/// Distance of a point from a component's surface and the nearest face.
struct NearestFace {
  static constexpr std::uint32_t kNone = 0xffffffffu;  ///< No face.

  double distance = std::numeric_limits<double>::infinity();  ///< Distance [mm].
  std::uint32_t face = kNone;                                 ///< kNone for a component without faces.
};

/// A lower bound of the distance from a point to the component's surface, from the tree's root box: 0 inside it [mm].
double distance_to_bounds(const SolidTree& solid, Vec3 point);

/// The nearest face, up to the rounding of closest_points_vertex_face(): branch and bound, the nearer boxes first.
/// @param point [mm, assembled state]
/// @param hint a face to start from: the nearer, the fewer nodes are visited; NearestFace::kNone for none
/// @param accept_below the search ends at the first face that is nearer than this [mm]; 0 for the nearest face
NearestFace nearest_face(const SolidTree& solid, Vec3 point, std::uint32_t hint, double accept_below = 0);

/// A point where a ray crosses a component's surface.
struct RayCrossing {
  double distance = 0;     ///< From the ray's origin [mm].
  bool outward = false;    ///< The ray leaves the solid there, by the face's normal.
  std::uint32_t face = 0;  ///< The face crossed.
};

/// All crossings of the ray from `point` along the unit vector `direction`, ordered by distance; nothing where the ray
/// passes too near to an edge to decide.
/// @param point [mm, assembled state]
std::optional<std::vector<RayCrossing>> crossings_of(const SolidTree& solid, Vec3 point, Vec3 direction);

/// True if `point` [mm, assembled state] lies inside the component, by inside_by_rays(). A point on the surface, as
/// near as rounding can tell, counts as outside. @pre the component is closed
bool point_in_solid(const SolidTree& solid, Vec3 point);

}  // namespace dismantle
