// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/families/oracle_mesh.h"
#include "dismantle/math/rigid_transform.h"

#include <cstddef>

namespace dismantle::families {

/// The depth of two meshes at one pose.
struct FoundDepth {
  double attained = 0;  ///< Of the deepest point found [mm].
  double bound = 0;     ///< No point is deeper [mm], unless the search was cut.
  Vec3 at;              ///< The deepest point [mm, frame of its own surface].
  bool of_first = true; ///< That is the surface of the first mesh.
  bool cut = false;     ///< There were more than `pieces`.
};

/// The greatest depth of a point of either surface inside the other solid; the deepest parts are divided first.
/// @param second_from_first pose of the first mesh in the frame of the second
/// @param gap the search ends where the bound is no more than this above the depth found [mm]
FoundDepth search_depth(const OracleMesh& first, const OracleMesh& second, const RigidTransform& second_from_first,
                        double gap, std::size_t pieces);

/// True if the surfaces are further apart than `gap` [mm] and neither mesh is inside the other.
bool apart(const OracleMesh& first, const OracleMesh& second, const RigidTransform& second_from_first, double gap);

}  // namespace dismantle::families
