// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/math/rigid_transform.h"

#include <string>
#include <unordered_map>
#include <vector>

namespace dismantle {

/// The rotation of URDF's rpy: about the fixed axes x, then y, then z [rad].
Mat3 rotation_from_rpy(Vec3 rpy);

/// Where a joint puts its child's frame in its parent's, at joint zero [m].
struct UrdfJoint {
  std::string name, parent, child;
  RigidTransform parent_from_child;
};

/// Where every link's frame is in the root's frame [m]; a link that is nobody's child is a root. Errors: Unreadable,
/// one sentence about `file`: a joint that names an unknown link, a link with two parents, a loop.
Result<std::unordered_map<std::string, RigidTransform>> urdf_link_frames(const std::string& file,
                                                                         const std::vector<std::string>& links,
                                                                         const std::vector<UrdfJoint>& joints);

}  // namespace dismantle
