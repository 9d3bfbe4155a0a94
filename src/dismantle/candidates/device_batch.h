// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/candidates/candidate_kernel.h"
#include "dismantle/candidates/find_near_lists.h"
#include "dismantle/candidates/motion_batch.h"
#include "dismantle/candidates/screw_kernels.h"
#include "dismantle/candidates/straight_sweep.h"
#include "dismantle/engine/chords.h"
#include "dismantle/math/screw.h"
#include "dismantle/streams/device/device_buffers.h"
#include "dismantle/streams/guarded_pairs.h"
#include "dismantle/streams/moving_streams.h"
#include "dismantle/streams/step_towards.h"

#include <algorithm>
#include <utility>

namespace dismantle {

/// MotionBatch on a device.
/// @tparam Queue the device: HostQueue or CudaQueue
template <class Queue>
class DeviceBatch final : public MotionBatch {
 public:
  /// @param assembly must outlive this
  DeviceBatch(Queue queue, const Assembly& assembly, const PairStates& pairs, const Executor& executor)
      : queue_(std::move(queue)),
        executor_(executor),
        assembly_(assembly),
        tolerance_(pairs.tolerance),
        host_(assembly, executor),
        guards_(assembly, pairs, host_.fixed(), {ElementaryTest::Certified, executor}),
        geometry_(queue_, host_.fixed()),
        displaced_(queue_, Span<const Vec3>(guards_.ghosts().displaced)),
        margins_(queue_, Span<const float>(guards_.ghosts().margins)),
        rule_table_(queue_, guards_.rules().table),
        straight_sweep_(queue_) {
    host_.set_margins(guards_.ghosts().margins, executor);
  }

  void set_state(Span<const Pose> poses, Span<const ComponentId> moving) override;
  std::vector<FirstContact> straight_contacts(Span<const Vec3> displacements) override;
  std::vector<FirstContact> screw_contacts(Span<const Pose> targets) override;

 private:
  static constexpr double kReachRounding = 1 + 1e-9;  // more than the rounding of a distance

  double path_deviation() const { return kArcShare * tolerance_; }
  CandidateScene scene() const;
  NearLists near_lists();
  std::vector<ScrewStation> stations_to(const Pose& target) const;
  std::vector<FirstContact> brought_down_contacts(std::size_t count);
  FirstContact contact_of(const CandidateContact& found) const;

  Queue queue_;
  Executor executor_;
  const Assembly& assembly_;
  double tolerance_;
  MovingStreams host_;
  GuardedPairs guards_;
  device_code::Geometry geometry_;
  DeviceArray<Vec3> displaced_;  // of the ghosts
  DeviceArray<float> margins_;   // of the leaves
  DeviceArray<PairRuleEntry> rule_table_;
  DeviceArray<RigidTransform> state_;
  DeviceArray<Vec3> vertices_;
  DeviceArray<Kdop16> bounds_;
  DeviceArray<NodeIndex> moving_roots_;
  DeviceArray<std::uint32_t> motion_class_;
  DeviceArray<NearLeaves> near_;  // of the state, once candidates wanted them
  DeviceArray<NearNormals> normals_;
  DeviceArray<NearLevels> levels_;
  DeviceArray<FarNodes> far_;
  std::size_t near_count_ = 0, far_count_ = 0;
  bool has_lists_ = false;
  std::vector<RigidTransform> host_state_;
  std::vector<NodeIndex> host_roots_;
  StraightSweep<Queue> straight_sweep_;
  // Of the last candidates; kept from call to call.
  DeviceArray<Vec3> displacements_;
  DeviceArray<ScrewStation> stations_;
  DeviceArray<std::uint32_t> station_begin_;
  DeviceArray<CandidateContact> found_;
  std::vector<std::uint32_t> moving_;  // motion_class_ on the host
  Pose start_;
  RigidSet set_;
};

template <class Queue>
void DeviceBatch<Queue>::set_state(Span<const Pose> poses, Span<const ComponentId> moving) {
  DISMANTLE_EXPECT(!moving.empty() && poses.size() == host_.fixed().component_count());
  has_lists_ = false;
  host_state_.clear();
  for (const Pose& pose : poses) host_state_.push_back(transform_from_pose(pose));
  host_.jump(host_state_, executor_);
  if (guards_.jump(host_state_)) rule_table_ = {queue_, guards_.rules().table};
  start_ = poses[moving[0].value];
  set_ = make_rigid_set(assembly_, {moving.begin(), moving.end()});
  moving_.assign(poses.size(), 0);
  host_roots_.clear();
  for (const ComponentId c : moving) {
    DISMANTLE_EXPECT(poses[c.value] == start_);
    moving_[c.value] = 1;
    const NodeIndex root = host_.fixed().bvh.components[c.value].root;
    if (root != kNoNode) host_roots_.push_back(root);
  }
  upload(queue_, state_, Span<const RigidTransform>(host_state_));
  upload(queue_, vertices_, host_.vertices_t0());
  upload(queue_, bounds_, host_.bounds());
  upload(queue_, moving_roots_, Span<const NodeIndex>(host_roots_));
  upload(queue_, motion_class_, Span<const std::uint32_t>(moving_));
}

template <class Queue>
CandidateScene DeviceBatch<Queue>::scene() const {
  return {geometry_.tree(),           bounds_.view(),
          geometry_.assembled.view(), vertices_.view(),
          geometry_.faces.view(),     moving_roots_.view().subspan(0, host_roots_.size()),
          motion_class_.view(),       {displaced_.view(), margins_.view(), state_.view(), state_.view()},
          {rule_table_.view()},       transform_from_pose(start_)};
}

template <class Queue>
NearLists DeviceBatch<Queue>::near_lists() {
  if (!has_lists_) {
    const AssemblyTriangles& fixed = host_.fixed();
    const GhostVertices& ghosts = guards_.ghosts();
    const FoundNearLists found = find_near_lists({BvhView(fixed.bvh),
                                                  host_.bounds(),
                                                  fixed.vertices,
                                                  host_.vertices_t0(),
                                                  fixed.faces,
                                                  host_roots_,
                                                  moving_,
                                                  {ghosts.displaced, ghosts.margins, host_state_, host_state_},
                                                  guards_.rules(),
                                                  transform_from_pose(start_)},
                                                 executor_);
    upload(queue_, near_, Span<const NearLeaves>(found.near));
    upload(queue_, normals_, Span<const NearNormals>(found.normals));
    upload(queue_, levels_, Span<const NearLevels>(found.levels));
    upload(queue_, far_, Span<const FarNodes>(found.far));
    near_count_ = found.near.size();
    far_count_ = found.far.size();
    has_lists_ = true;
  }
  return {near_.view().subspan(0, near_count_), normals_.view().subspan(0, near_count_),
          levels_.view().subspan(0, near_count_), far_.view().subspan(0, far_count_)};
}

template <class Queue>
std::vector<FirstContact> DeviceBatch<Queue>::straight_contacts(Span<const Vec3> displacements) {
  const std::size_t count = displacements.size();
  const NearLists lists = near_lists();
  const Span<const Vec3> uploaded = upload(queue_, displacements_, displacements);
  straight_sweep_.run(queue_, scene(), lists, uploaded, room_for(queue_, found_, count));
  return brought_down_contacts(count);
}

/// The poses that divide the screw into pieces with chords near enough to the arcs; the start first.
template <class Queue>
std::vector<ScrewStation> DeviceBatch<Queue>::stations_to(const Pose& target) const {
  const RigidTransform start = transform_from_pose(start_);
  const Vec3 center = start * set_.center;
  const Screw screw = screw_between(start_, target);
  const double rho = screw_radius(screw, center, set_.radius);
  const int pieces = chord_count(screw_chord_deviation(screw, rho), path_deviation());
  std::vector<ScrewStation> stations;
  for (int k = 0; k <= pieces; ++k) {
    const double share = static_cast<double>(k) / pieces;
    const RigidTransform pose = transform_from_pose(pose_between(start_, target, share));
    // A point moves as the center does, and turns about it.
    const double turned = 2 * std::sin(0.5 * share * screw.angle) * set_.radius;
    stations.push_back({pose, kReachRounding * (length(pose * set_.center - center) + turned)});
  }
  return stations;
}

template <class Queue>
std::vector<FirstContact> DeviceBatch<Queue>::screw_contacts(Span<const Pose> targets) {
  std::vector<std::vector<ScrewStation>> of_targets(targets.size());
  executor_.for_each(targets.size(), [&](std::size_t i) { of_targets[i] = stations_to(targets[i]); });
  std::vector<ScrewStation> stations;
  std::vector<std::uint32_t> begin{0};
  for (const std::vector<ScrewStation>& added : of_targets) {
    stations.insert(stations.end(), added.begin(), added.end());
    begin.push_back(static_cast<std::uint32_t>(stations.size()));
  }
  const NearLists lists = near_lists();
  const Span<const ScrewStation> uploaded = upload(queue_, stations_, Span<const ScrewStation>(stations));
  const Span<const std::uint32_t> begins = upload(queue_, station_begin_, Span<const std::uint32_t>(begin));
  queue_.launch(targets.size(),
                SweepTurning{scene(), lists, uploaded, begins, room_for(queue_, found_, targets.size())});
  return brought_down_contacts(targets.size());
}

template <class Queue>
std::vector<FirstContact> DeviceBatch<Queue>::brought_down_contacts(std::size_t count) {
  const std::vector<CandidateContact> found = brought_down(queue_, found_, count);
  std::vector<FirstContact> contacts(count);
  executor_.for_each(count, [&](std::size_t i) { contacts[i] = contact_of(found[i]); });
  return contacts;
}

template <class Queue>
FirstContact DeviceBatch<Queue>::contact_of(const CandidateContact& found) const {
  FirstContact contact;
  if (found.key == CandidateContact::kFree) return contact;
  const AssemblyTriangles& fixed = host_.fixed();
  NodePair leaves = pair_of_key(found.key);
  if (moving_[fixed.bvh.component_of[leaves.a]] == 0) std::swap(leaves.a, leaves.b);
  contact.toi = found.toi;
  contact.free = false;
  contact.moving = ComponentId(fixed.bvh.component_of[leaves.a]);
  contact.fixed = ComponentId(fixed.bvh.component_of[leaves.b]);
  contact.face_moving = fixed.face_of[leaves.a];
  contact.face_fixed = fixed.face_of[leaves.b];
  return contact;
}

}  // namespace dismantle
