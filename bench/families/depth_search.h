// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/families/oracle_mesh.h"
#include "dismantle/math/rigid_transform.h"

#include <cstddef>

namespace dismantle::families {

/// The depth of two meshes at one pose.
struct FoundDepth {
  double attained = 0;   ///< Of the deepest point found [mm].
  double bound = 0;      ///< No point is deeper [mm], if above the floor and the search was not cut.
  Vec3 at;               ///< The deepest point [mm, frame of its own surface].
  bool of_first = true;  ///< That is the surface of the first mesh.
  bool cut = false;      ///< The search ended early.
};

/// How closely the depth is searched for.
struct DepthEffort {
  double gap = 0;              ///< Depths are found to within this, or 1% [mm].
  std::size_t pieces = 40000;  ///< The search ends after so many.
  double floor = 0;            ///< Smaller depths do not matter [mm].
};

/// The greatest depth of a point of either surface inside the other solid; the deepest parts are divided first.
/// @param second_from_first pose of the first mesh in the frame of the second
FoundDepth search_depth(const OracleMesh& first, const OracleMesh& second, const RigidTransform& second_from_first,
                        const DepthEffort& effort);

/// True if the surfaces are further apart than `gap` [mm] and neither mesh is inside the other.
bool apart(const OracleMesh& first, const OracleMesh& second, const RigidTransform& second_from_first, double gap);

}  // namespace dismantle::families
