// SPDX-License-Identifier: Apache-2.0
#include "dismantle/collision/certificate_sweeper.h"

#include "dismantle/core/contract.h"

#include <algorithm>
#include <limits>

namespace dismantle {

namespace {

SolidTree solid_of(const Component& component, const Executor& executor) {
  SolidTree solid;
  solid.vertices = assembled_vertices(component);
  solid.faces = component.mesh->faces;
  solid.closed = component.faults.closed() && !component.faults.inside_out;
  solid.tree = obb_tree_build(solid.vertices, solid.faces, executor);
  return solid;
}

/// `pose` in the frame of something at `frame`; exact where that is the assembled pose.
Pose seen_from(const Pose& frame, const Pose& pose) {
  return frame == Pose{} ? pose : inverse(frame) * pose;
}

bool before(const BlockedPair& x, const BlockedPair& y) {
  if (x.moving != y.moving) return x.moving < y.moving;
  if (x.fixed != y.fixed) return x.fixed < y.fixed;
  if (x.face_moving != y.face_moving) return x.face_moving < y.face_moving;
  return x.face_fixed < y.face_fixed;
}

}  // namespace

/// A pair whose spheres may come near each other in a sweep.
struct CertificateSweeper::ActivePair {
  ComponentId moving, fixed;
  CertificateFront* front;
  LeafSweep leaves;
  PairSweep sweep;
};

/// One part of one front, and what its sweep found.
struct CertificateSweeper::PartTask {
  std::size_t pair, part;
  double horizon = 1;  // what comes later would not happen
  FrontSweep found;
  std::vector<BlockedPair> blocked;
};

CertificateSweeper::CertificateSweeper(const Assembly& assembly, const PairStates& pairs,
                                       const CertificateOptions& options)
    : assembly_(&assembly),
      options_(options),
      kernels_(front_kernels(options.lanes)),
      rules_(pairs),
      poses_(assembly.components.size()),
      is_held_(assembly.components.size()) {
  for (const Component& c : assembly.components) {
    solids_.push_back(solid_of(c, options.executor));
    const Aabb box = assembled_bounds(c);
    centers_.push_back(box.empty() ? Vec3{} : box.center());
    double radius = 0;
    for (const Vec3& p : solids_.back().vertices) radius = std::max(radius, length(p - centers_.back()));
    radii_.push_back(radius);
  }
}

void CertificateSweeper::hold(Span<const ComponentId> components) {
  DISMANTLE_EXPECT(!components.empty());
  held_.assign(components.begin(), components.end());
  std::sort(held_.begin(), held_.end());
  std::fill(is_held_.begin(), is_held_.end(), false);
  Aabb box;
  for (const ComponentId c : held_) {
    DISMANTLE_EXPECT(poses_[c.value] == pose());
    is_held_[c.value] = true;
    box.extend(assembled_bounds((*assembly_)[c]));
  }
  center_ = box.empty() ? Vec3{} : box.center();
  radius_ = 0;
  for (const ComponentId c : held_)
    for (const Vec3& p : solids_[c.value].vertices) radius_ = std::max(radius_, length(p - center_));
}

double CertificateSweeper::deviation(const Pose& end) const {
  const Screw screw = screw_between(pose(), end);
  return screw_chord_deviation(screw, screw_radius(screw, center(), radius_));
}

double CertificateSweeper::travel(const Pose& end) const {
  const Screw screw = screw_between(pose(), end);
  return screw_path_length(screw, screw_radius(screw, center(), radius_));
}

double CertificateSweeper::allowed(ComponentId a, ComponentId b) const {
  const PairRule rule = rules_.view().find(std::min(a, b).value, std::max(a, b).value);
  return rule.test == PairTest::Discrete ? -1 : rule.allowed_penetration;
}

CertificateSweeper::FrontEntry& CertificateSweeper::front_of(ComponentId moving, ComponentId fixed) {
  const ComponentId a = std::min(moving, fixed), b = std::max(moving, fixed);
  auto found = fronts_.find({a, b});
  if (found == fronts_.end())
    found =
        fronts_
            .emplace(std::pair{a, b},
                     FrontEntry{CertificateFront(solids_[a.value].tree, solids_[b.value].tree, sides(a, b)), false, {}})
            .first;
  FrontEntry& entry = found->second;
  if (entry.b_moves != (moving == b)) {
    const Mat3 of_moving = mat3_from_quat(poses_[moving.value].rotation);
    const Mat3 of_fixed = mat3_from_quat(poses_[fixed.value].rotation);
    // What stands still now is what moved so far.
    entry.front.exchange_roles(transposed(of_moving) * of_fixed);
    entry.b_moves = moving == b;
  } else if (!(entry.fixed_pose == poses_[fixed.value])) {
    entry.front.forget();
  }
  entry.fixed_pose = poses_[fixed.value];
  return entry;
}

SideRule CertificateSweeper::sides(ComponentId a, ComponentId b) const {
  if (!solid(a).closed || !solid(b).closed) return SideRule::Memory;
  return allowed(a, b) > tolerance() ? SideRule::Free : SideRule::Normals;
}

LeafSweep CertificateSweeper::leaf_sweep(ComponentId moving, ComponentId fixed, const Pose& end, double arcs) const {
  const Pose& frame = poses_[fixed.value];
  return LeafSweep(solid(moving), solid(fixed), seen_from(frame, pose()), seen_from(frame, end), arcs,
                   allowed(moving, fixed), tolerance(), sides(moving, fixed));
}

LeafSweep::Result CertificateSweeper::sweep_pair(const BlockedPair& pair, const Pose& end) const {
  return leaf_sweep(pair.moving, pair.fixed, end, deviation(end))
      .test(pair.face_moving.value, pair.face_fixed.value, pair.axis);
}

std::vector<CertificateSweeper::ActivePair> CertificateSweeper::active_pairs(const Pose& end, double travel,
                                                                             CertificateSweep& result) {
  std::vector<ActivePair> active;
  const double arcs = deviation(end);
  const RigidTransform start = transform_from_pose(pose());
  for (const ComponentId moving : held_) {
    if (solids_[moving.value].tree.empty()) continue;
    const Vec3 center = start * centers_[moving.value];
    for (std::uint32_t k = 0; k < poses_.size(); ++k) {
      const ComponentId fixed(k);
      if (is_held_[k] || solids_[k].tree.empty()) continue;
      const Vec3 other = poses_[k] == Pose{} ? centers_[k] : transform_from_pose(poses_[k]) * centers_[k];
      const double margin = 1e-9 * (max_abs(center) + max_abs(other));
      const double gap = length(center - other) - radii_[moving.value] - radii_[k] - travel - margin;
      if (gap > 0) {
        result.clearance = std::min(result.clearance, gap);
        continue;
      }
      if (allowed(moving, fixed) < 0) continue;
      FrontEntry& entry = front_of(moving, fixed);
      LeafSweep leaves = leaf_sweep(moving, fixed, end, arcs);
      const PairSweep sweep = entry.front.begin_sweep(leaves.motion());
      active.push_back({moving, fixed, &entry.front, std::move(leaves), sweep});
    }
  }
  return active;
}

CertificateSweep CertificateSweeper::sweep(const Pose& end, double window) {
  CertificateSweep result;
  result.clearance = std::numeric_limits<double>::infinity();
  std::vector<ActivePair> active = active_pairs(end, travel(end), result);
  std::vector<PartTask> tasks;
  for (std::size_t p = 0; p < active.size(); ++p)
    for (std::size_t part = 0; part < active[p].front->part_count(); ++part) tasks.push_back({p, part, 1, {}, {}});

  const auto run = [&](std::size_t i) {
    PartTask& task = tasks[i];
    const ActivePair& pair = active[task.pair];
    const LeafTest test = [&](std::uint32_t moving, std::uint32_t fixed, Vec3f hint) {
      const LeafSweep::Result found = pair.leaves.test(moving, fixed, {hint.x, hint.y, hint.z}, task.horizon);
      if (!found.free) {
        task.horizon = std::min(task.horizon, found.contact.toi + window);
        task.blocked.push_back(
            {pair.moving, pair.fixed, FaceId(moving), FaceId(fixed), found.contact.toi, found.contact.axis});
      }
      return LeafVerdict{found.free, pair.leaves.certificate(moving, fixed, found.contact.axis, pair.sweep)};
    };
    task.found = pair.front->sweep_part(task.part, pair.sweep, kernels_, test);
  };
  if (tasks.size() == 1) {
    run(0);
  } else {
    options_.executor.for_each_heavy(tasks.size(), run);
  }

  for (PartTask& task : tasks) {
    const PairSweep& sweep = active[task.pair].sweep;
    result.clearance = std::min<double>(result.clearance, task.found.least_gap - sweep.error);
    result.leaf_tests += task.found.leaf_tests;
    result.blocked.insert(result.blocked.end(), task.blocked.begin(), task.blocked.end());
  }
  for (const ActivePair& pair : active) {
    pair.front->end_sweep();
    result.front += pair.front->size();
  }
  std::sort(result.blocked.begin(), result.blocked.end(), before);
  for (const BlockedPair& b : result.blocked) result.toi = std::min(result.toi, b.toi);
  std::erase_if(result.blocked, [&](const BlockedPair& b) { return b.toi > result.toi + window; });
  result.free = result.blocked.empty();
  result.clearance = result.free ? std::max(0.0, result.clearance) : 0;
  return result;
}

void CertificateSweeper::move_to(const Pose& pose) {
  for (const ComponentId c : held_) poses_[c.value] = pose;
}

void CertificateSweeper::jump(Span<const Pose> poses) {
  DISMANTLE_EXPECT(poses.size() == poses_.size());
  poses_.assign(poses.begin(), poses.end());
}

std::size_t CertificateSweeper::front_size() const {
  std::size_t size = 0;
  for (const auto& [pair, entry] : fronts_)
    if (is_held_[pair.first.value] != is_held_[pair.second.value]) size += entry.front.size();
  return size;
}

}  // namespace dismantle
