// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/urdf/urdf_kinematics.h"

#include "dismantle/formats/import/mesh_source.h"

#include <cmath>

namespace dismantle {

Mat3 rotation_from_rpy(Vec3 rpy) {
  const double cr = std::cos(rpy.x), sr = std::sin(rpy.x);
  const double cp = std::cos(rpy.y), sp = std::sin(rpy.y);
  const double cy = std::cos(rpy.z), sy = std::sin(rpy.z);
  return {{{cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr},
           {sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr},
           {-sp, cp * sr, cp * cr}}};
}

Result<std::unordered_map<std::string, RigidTransform>> urdf_link_frames(const std::string& file,
                                                                         const std::vector<std::string>& links,
                                                                         const std::vector<UrdfJoint>& joints) {
  const MeshSource source{{}, file};
  std::unordered_map<std::string, const UrdfJoint*> joint_of;  // by its child; null for a root
  for (const std::string& link : links) joint_of.emplace(link, nullptr);
  std::unordered_map<std::string, std::vector<const UrdfJoint*>> joints_below;
  for (const UrdfJoint& joint : joints) {
    const auto child = joint_of.find(joint.child);
    if (child == joint_of.end() || joint_of.count(joint.parent) == 0)
      return malformed(source, "URDF", "joint " + in_quotes(joint.name) + " names a link that is not there");
    if (child->second != nullptr)
      return malformed(source, "URDF", "link " + in_quotes(joint.child) + " has two parents");
    child->second = &joint;
    joints_below[joint.parent].push_back(&joint);
  }

  std::unordered_map<std::string, RigidTransform> frames;
  std::vector<std::string> open;
  for (const std::string& link : links)
    if (joint_of[link] == nullptr && frames.emplace(link, RigidTransform{}).second) open.push_back(link);
  while (!open.empty()) {
    const std::string parent = std::move(open.back());
    open.pop_back();
    const RigidTransform root_from_parent = frames[parent];
    for (const UrdfJoint* joint : joints_below[parent]) {
      frames.emplace(joint->child, root_from_parent * joint->parent_from_child);
      open.push_back(joint->child);
    }
  }
  for (const std::string& link : links)
    if (frames.count(link) == 0)
      return malformed(source, "URDF", "link " + in_quotes(link) + " hangs in a loop of joints");
  return frames;
}

}  // namespace dismantle
