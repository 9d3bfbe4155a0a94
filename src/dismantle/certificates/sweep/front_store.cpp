// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/sweep/front_store.h"

#include <algorithm>

namespace dismantle {

FrontStore::FrontStore(const Assembly& assembly, const Executor& executor) {
  for (const Component& c : assembly.components) {
    solids_.push_back(make_solid_tree(c, executor));
    const Aabb box = assembled_bounds(c);
    const Vec3 center = box.empty() ? Vec3{} : box.center();
    double radius = 0;
    for (const Vec3& p : solids_.back().vertices) radius = std::max(radius, length(p - center));
    spheres_.add(center, radius);
  }
  prepare_radial(executor);
}

void FrontStore::prepare_radial(const Executor& executor) {
  std::vector<PairKey> near;
  for (std::uint32_t a = 0; a < solids_.size(); ++a)
    for (std::uint32_t b = a + 1; b < solids_.size(); ++b)
      if (solids_[a].revolution && solids_[b].revolution &&
          spheres_.gap(ComponentId(a), {}, {}, 0, ComponentId(b), Pose{}) <= 0)
        near.emplace_back(a, b);
  std::vector<std::vector<ThreadMatch>> threads(near.size());
  executor.for_each_heavy(near.size(), [&](std::size_t i) {
    const SolidTree &a = solid(near[i].first), &b = solid(near[i].second);
    threads[i] = match_threads(*a.revolution, a.tree.origin, *b.revolution, b.tree.origin);
    PairMotion still;
    still.t0 = still.t1 = {{}, a.tree.origin - b.tree.origin};
    RadialSweeps(*a.revolution, a.tree.origin, *b.revolution, b.tree.origin, still).get();
  });
  for (std::size_t i = 0; i < near.size(); ++i)
    if (!threads[i].empty()) threads_[near[i]] = std::move(threads[i]);
}

CertificateFront FrontStore::new_front(ComponentId a, ComponentId b, SideRule sides) const {
  const auto threads = threads_.find({a, b});
  return {solid(a).tree,
          solid(b).tree,
          sides,
          solid(a).revolution.get(),
          solid(b).revolution.get(),
          threads == threads_.end() ? Span<const ThreadMatch>{} : threads->second};
}

CertificateFront& FrontStore::prepare(ComponentId moving, ComponentId fixed, SideRule sides, Span<const Pose> poses) {
  const ComponentId a = std::min(moving, fixed), b = std::max(moving, fixed);
  auto found = fronts_.find({a, b});
  if (found == fronts_.end()) found = fronts_.emplace(PairKey{a, b}, Entry{new_front(a, b, sides), false, {}}).first;
  Entry& entry = found->second;
  if (entry.b_moves != (moving == b)) {
    const Mat3 of_moving = mat3_from_quat(poses[moving.value].rotation);
    const Mat3 of_fixed = mat3_from_quat(poses[fixed.value].rotation);
    // The component that is fixed now has moved so far.
    entry.front.exchange_roles(transposed(of_moving) * of_fixed);
    entry.b_moves = moving == b;
  } else if (!(entry.fixed_pose == poses[fixed.value])) {
    entry.front.forget();
  }
  entry.fixed_pose = poses[fixed.value];
  return entry.front;
}

const CertificateFront* FrontStore::find(ComponentId moving, ComponentId fixed, const Pose& pose_fixed) const {
  const ComponentId a = std::min(moving, fixed), b = std::max(moving, fixed);
  const auto known = fronts_.find({a, b});
  const bool usable =
      known != fronts_.end() && known->second.b_moves == (moving == b) && known->second.fixed_pose == pose_fixed;
  return usable ? &known->second.front : nullptr;
}

std::size_t FrontStore::size(const std::vector<bool>& is_moving) const {
  std::size_t size = 0;
  for (const auto& [pair, entry] : fronts_)
    if (is_moving[pair.first.value] != is_moving[pair.second.value]) size += entry.front.size();
  return size;
}

}  // namespace dismantle
