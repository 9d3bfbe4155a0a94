// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/path.h"
#include "dismantle/audit/audit_report.h"
#include "dismantle/core/span.h"

#include <vector>

namespace dismantle::audit {

/// Largest difference between a move's first frame and the poses of its components: relative to the larger of the
/// position's size and 1 mm, and absolute for the quaternion.
inline constexpr double kPoseAgreement = 1e-9;

/// Checks the path's header, pairs and list of removed components: names that the assembly does not have or that are
/// repeated, and invalid numbers.
std::vector<AuditViolation> check_declarations(const Assembly& assembly, const Path& path);

/// Checks move `index`: names, times, numbers, unit quaternions, and that its first frame is the pose of all its
/// components. @param poses of all components before the move
std::vector<AuditViolation> check_move(const Assembly& assembly, const Path& path, std::size_t index,
                                       Span<const Pose> poses);

/// True if the move has frames and all their numbers are finite, so that it can be swept.
bool can_follow(const Move& move);

/// Checks that components which end further from the assembly's bounding box than its diagonal are listed as removed.
std::vector<AuditViolation> check_removed(const Assembly& assembly, const Path& path, Span<const Pose> final_poses);

}  // namespace dismantle::audit
