// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/path.h"
#include "dismantle/audit/audit_path.h"
#include "tests/support/meshes.h"

#include <string>
#include <utility>
#include <vector>

/// Paths and moves for the tests of the audit.
namespace dismantle::audit_scenes {

/// A path without moves, of version 1: its pairs are what the audit finds.
inline Path path_of(const Assembly& assembly, double tolerance) {
  Path path;
  path.version = 1;
  path.tolerance = tolerance;
  for (const Component& component : assembly.components) path.components.push_back(component.name);
  return path;
}

/// One move of `names` through the poses, 0.1 s from frame to frame.
inline Move move_through(std::vector<std::string> names, const std::vector<Pose>& poses) {
  Move move;
  move.label = "move";
  move.components = std::move(names);
  for (std::size_t k = 0; k < poses.size(); ++k) move.frames.push_back({0.1 * static_cast<double>(k), poses[k]});
  return move;
}

inline Pose shifted(double x, double y, double z) {
  return {{x, y, z}, {}};
}

/// The pose after a turn by `angle` about the axis through `point` along z.
inline Pose turned_about_z(double angle, Vec3 point) {
  const Quat q = quat_about({0, 0, 1}, angle);
  return {point - mat3_from_quat(q) * point, q};
}

inline std::size_t count(const AuditReport& report, AuditViolationKind kind) {
  std::size_t found = 0;
  for (const AuditViolation& violation : report.violations) found += violation.kind == kind ? 1 : 0;
  return found;
}

/// All messages, for the output of a failed test.
inline std::string messages(const AuditReport& report) {
  std::string text;
  for (const AuditViolation& violation : report.violations) text += violation.message + "\n";
  return text;
}

}  // namespace dismantle::audit_scenes
