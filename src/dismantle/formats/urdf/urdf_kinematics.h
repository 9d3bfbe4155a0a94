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

/// A joint: the placement of its child's frame in its parent's, at joint zero.
struct UrdfJoint {
  std::string name;                  ///< Of the joint.
  std::string parent;                ///< Name of the parent link.
  std::string child;                 ///< Name of the child link.
  RigidTransform parent_from_child;  ///< [m]
};

/// The frame of every link in its root's frame [m]; a link that is nobody's child is a root. Errors: Unreadable, one
/// sentence about `file`: a joint with an unknown link, a link with two parents, a loop.
Result<std::unordered_map<std::string, RigidTransform>> urdf_link_frames(const std::string& file,
                                                                         const std::vector<std::string>& links,
                                                                         const std::vector<UrdfJoint>& joints);

}  // namespace dismantle
