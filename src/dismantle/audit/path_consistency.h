// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/path.h"
#include "dismantle/audit/audit_report.h"
#include "dismantle/core/span.h"

#include <vector>

namespace dismantle::audit {

/// How far a move's first frame may be from where its components are: relative to the position's size and to 1 mm, and
/// absolute for the quaternion.
inline constexpr double kPoseAgreement = 1e-9;

/// What is wrong with the path's header, pairs and list of removed components: names that the assembly does not have
/// or that come twice, numbers that make no sense.
std::vector<AuditViolation> check_declarations(const Assembly& assembly, const Path& path);

/// What is wrong with move `index`, given the poses that the components have before it: names, times, numbers, unit
/// quaternions, and that it starts where its components are, which must be one pose.
std::vector<AuditViolation> check_move(const Assembly& assembly, const Path& path, std::size_t index,
                                       Span<const Pose> poses);

/// True where the move's frames can be followed: there are some, and all numbers are finite.
bool can_follow(const Move& move);

/// Components that end further than the assembly's bounding box (its diagonal) from it must be listed as removed.
std::vector<AuditViolation> check_removed(const Assembly& assembly, const Path& path, Span<const Pose> final_poses);

}  // namespace dismantle::audit
