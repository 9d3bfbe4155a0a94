// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/surface/solid_tree.h"

#include <limits>
#include <optional>
#include <vector>

namespace dismantle {

/// The face of a component's surface that is nearest to a point.
struct NearestFace {
  static constexpr std::uint32_t kNone = 0xffffffffu;

  double distance = std::numeric_limits<double>::infinity();  ///< Of the point from it [mm].
  std::uint32_t face = kNone;                                 ///< None for a component without faces.
};

/// A lower bound of the distance from a point to the component's surface, from the tree's root alone: 0 inside its box
/// [mm].
double distance_to_bounds(const SolidTree& solid, Vec3 point);

/// The nearest face, up to the rounding of closest_points_vertex_face.
/// @param point [mm, assembled]
/// @param hint a face to begin with: the nearer it is the less is looked at; NearestFace::kNone for none
/// @param enough the search may end with any face that is nearer than this [mm]; 0 for the nearest
NearestFace nearest_face(const SolidTree& solid, Vec3 point, std::uint32_t hint, double enough = 0);

/// Where a ray goes through a component's surface.
struct RayCrossing {
  double distance = 0;   ///< From where it begins [mm].
  bool outward = false;  ///< It comes out there, by the face's normal.
  std::uint32_t face = 0;
};

/// All crossings of the ray from `point` along the unit vector `direction`, the first one first; nothing where it comes
/// too near to an edge to tell.
std::optional<std::vector<RayCrossing>> crossings_of(const SolidTree& solid, Vec3 point, Vec3 direction);

/// As point_in_component (solid_query.h), of the assembled component. @pre it is closed
bool point_in_solid(const SolidTree& solid, Vec3 point);

}  // namespace dismantle
