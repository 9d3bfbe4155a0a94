// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/path_consistency.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <unordered_set>

namespace dismantle::audit {

namespace {

AuditViolation inconsistent(std::size_t move, std::size_t frame, double time, std::string message) {
  AuditViolation violation;
  violation.move = move;
  violation.frame = frame;
  violation.time = time;
  violation.message = std::move(message);
  return violation;
}

AuditViolation inconsistent(std::string message) {
  return inconsistent(AuditViolation::kAssembledState, 0, 0, std::move(message));
}

std::string quoted(const std::string& name) {
  return "\"" + name + "\"";
}

bool finite(const Pose& pose) {
  const Quat& q = pose.rotation;
  return is_finite(pose.position) && is_finite(Vec3{q.x, q.y, q.z}) && std::isfinite(q.w);
}

/// True if two poses agree within kPoseAgreement; q and -q are the same rotation.
bool same_pose(const Pose& a, const Pose& b) {
  const double scale = std::max({1.0, max_abs(a.position), max_abs(b.position)});
  if (!(max_abs(a.position - b.position) <= kPoseAgreement * scale)) return false;
  const Quat other = nearer_to(a.rotation, b.rotation);
  const Quat d{a.rotation.w - other.w, a.rotation.x - other.x, a.rotation.y - other.y, a.rotation.z - other.z};
  return dot(d, d) <= kPoseAgreement * kPoseAgreement;
}

/// Messages about names in a list that the assembly does not have or that are repeated.
std::vector<std::string> wrong_names(const Assembly& assembly, const std::vector<std::string>& names,
                                     const std::string& where) {
  std::vector<std::string> messages;
  std::unordered_set<std::string> seen;
  for (const std::string& name : names) {
    if (!assembly.find(name))
      messages.push_back(where + " names " + quoted(name) + ", which the assembly does not have");
    if (!seen.insert(name).second) messages.push_back(where + " names " + quoted(name) + " twice");
  }
  return messages;
}

std::vector<std::string> wrong_pair(const Assembly& assembly, const PathPair& pair) {
  std::vector<std::string> messages;
  const std::string where = "the pair " + quoted(pair.a) + ", " + quoted(pair.b);
  for (const std::string& name : {pair.a, pair.b})
    if (!assembly.find(name))
      messages.push_back(where + " names " + quoted(name) + ", which the assembly does not have");
  if (pair.a == pair.b) messages.push_back(where + " is one component with itself");
  const bool known =
      pair.state == PathPairState::Free || (pair.allowed_depth >= 0 && std::isfinite(pair.allowed_depth));
  if (!known) messages.push_back(where + " has no finite allowed depth, though it is not free");
  if (!(pair.initial_depth >= 0 && std::isfinite(pair.initial_depth)))
    messages.push_back(where + " has no finite depth at the start");
  return messages;
}

}  // namespace

std::vector<AuditViolation> check_declarations(const Assembly& assembly, const Path& path) {
  std::vector<AuditViolation> violations;
  const auto add = [&violations](const std::vector<std::string>& messages) {
    for (const std::string& message : messages) violations.push_back(inconsistent(message));
  };
  if (!(path.tolerance >= 0 && std::isfinite(path.tolerance)))
    add({"the tolerance is not a finite length (" + std::to_string(path.tolerance) + " mm)"});
  add(wrong_names(assembly, path.components, "the list of components"));
  add(wrong_names(assembly, path.removed, "the list of removed components"));
  std::set<std::pair<std::string, std::string>> seen;
  for (const PathPair& pair : path.pairs) {
    add(wrong_pair(assembly, pair));
    if (!seen.insert(std::minmax(pair.a, pair.b)).second)
      add({"the pair " + quoted(pair.a) + ", " + quoted(pair.b) + " comes twice"});
  }
  return violations;
}

std::vector<AuditViolation> check_move(const Assembly& assembly, const Path& path, std::size_t index,
                                       Span<const Pose> poses) {
  const Move& move = path.moves[index];
  std::vector<AuditViolation> violations;
  const auto add = [&](std::size_t frame, const std::string& message) {
    const double time = frame < move.frames.size() ? move.frames[frame].time : 0;
    violations.push_back(inconsistent(index, frame, time, message));
  };
  for (const std::string& message : wrong_names(assembly, move.components, "the move")) add(0, message);
  if (move.components.empty()) add(0, "the move names no component");
  if (move.frames.empty()) {
    add(0, "the move has no frames");
    return violations;
  }

  if (move.frames.front().time != 0) add(0, "its time does not start at 0");
  for (std::size_t k = 0; k < move.frames.size(); ++k) {
    const Frame& frame = move.frames[k];
    if (!finite(frame.pose) || !std::isfinite(frame.time)) {
      add(k, "frame " + std::to_string(k) + " has a number that is not finite");
    } else if (std::fabs(dot(frame.pose.rotation, frame.pose.rotation) - 1) > 2 * kPoseAgreement) {
      add(k, "the quaternion of frame " + std::to_string(k) + " is not of unit length");
    }
    if (k > 0 && !(frame.time >= move.frames[k - 1].time)) add(k, "time runs backwards at frame " + std::to_string(k));
  }
  for (const std::string& name : move.components) {
    const auto id = assembly.find(name);
    if (id && !same_pose(poses[id->value], move.frames.front().pose))
      add(0, "its first frame is not the pose that " + quoted(name) + " has at that time");
  }
  return violations;
}

bool can_follow(const Move& move) {
  return !move.frames.empty() && std::all_of(move.frames.begin(), move.frames.end(), [](const Frame& frame) {
    return finite(frame.pose) && dot(frame.pose.rotation, frame.pose.rotation) > 0.5;
  });
}

std::vector<AuditViolation> check_removed(const Assembly& assembly, const Path& path, Span<const Pose> final_poses) {
  std::vector<AuditViolation> violations;
  const Aabb assembled = assembled_bounds(assembly);
  for (std::size_t c = 0; c < assembly.components.size(); ++c) {
    const Component& component = assembly.components[c];
    if (final_poses[c] == Pose{} ||
        std::find(path.removed.begin(), path.removed.end(), component.name) != path.removed.end())
      continue;
    Aabb box;
    const RigidTransform transform = transform_from_pose(final_poses[c]);
    for (const Vec3& p : assembled_vertices(component)) box.extend(transform * p);
    if (box.empty()) continue;
    const Vec3 apart = max(max(box.lower - assembled.upper, assembled.lower - box.upper), Vec3{});
    if (length(apart) > diagonal(assembled))
      violations.push_back(inconsistent(quoted(component.name) +
                                        " ends further than the assembly's size from it and is not listed as removed"));
  }
  return violations;
}

}  // namespace dismantle::audit
