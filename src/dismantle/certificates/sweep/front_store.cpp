// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/sweep/front_store.h"

#include "dismantle/surface/ghost_surface.h"

#include <algorithm>

namespace dismantle {

FrontStore::FrontStore(const Assembly& assembly, double ghost_length, const Executor& executor)
    : solids_(assembly.components.size()), ghosts_(assembly.components.size()) {
  std::vector<double> radii(solids_.size());
  std::vector<Vec3> centers(solids_.size());
  std::size_t all_faces = 0;
  for (const Component& c : assembly.components) all_faces += c.mesh->faces.size();
  // Components that are more than a thread's share are built on all threads, the others side by side.
  const auto is_large = [&](const Component& c) {
    return c.mesh->faces.size() * static_cast<std::size_t>(executor.thread_count()) > all_faces;
  };
  const auto build = [&](std::size_t c, const Executor& on) {
    const Component& component = assembly.components[c];
    SolidTree& solid = solids_[c] = make_solid_tree(component, on);
    // Sheets have no inside to retreat to.
    std::vector<Vec3> displaced = solid.vertices;
    if (solid.has_outside || solid.inside_out)
      displaced = ghost_vertices(displaced, outward_faces(solid.faces, solid.inside_out), ghost_length);
    ghosts_[c] = make_displaced_tree(solid, std::move(displaced), on);
    const Aabb box = assembled_bounds(component);
    centers[c] = box.empty() ? Vec3{} : box.center();
    for (const Vec3& p : solid.vertices) radii[c] = std::max(radii[c], length(p - centers[c]));
  };
  for (std::size_t c = 0; c < solids_.size(); ++c)
    if (is_large(assembly.components[c])) build(c, executor);
  executor.for_each_heavy(solids_.size(), [&](std::size_t c) {
    if (!is_large(assembly.components[c])) build(c, Executor{});
  });
  for (std::size_t c = 0; c < solids_.size(); ++c) spheres_.add(centers[c], radii[c]);
  prepare_radial(executor);
}

const SolidTree& FrontStore::ghost(ComponentId c, ComponentId other) const {
  const auto own = pair_ghosts_.find({std::min(c, other), std::max(c, other)});
  return own == pair_ghosts_.end() || !own->second.in_use ? ghosts_[c.value] : own->second.ghosts[c < other ? 0 : 1];
}

void FrontStore::set_ghosts(Span<const FoundGuard> guards, const Executor& executor) {
  std::vector<const FoundGuard*> own;
  for (const FoundGuard& guard : guards)
    if (!guard.ghosts[0].empty()) own.push_back(&guard);
  std::vector<PairTrees> trees(own.size());
  executor.for_each_heavy(own.size(), [&](std::size_t i) {
    trees[i].ghosts[0] = make_displaced_tree(solid(own[i]->a), own[i]->ghosts[0], Executor{});
    trees[i].ghosts[1] = make_displaced_tree(solid(own[i]->b), own[i]->ghosts[1], Executor{});
  });
  for (std::size_t i = 0; i < own.size(); ++i) pair_ghosts_[{own[i]->a, own[i]->b}] = std::move(trees[i]);
}

void FrontStore::use_own_ghosts(ComponentId a, ComponentId b, bool own) {
  const auto found = pair_ghosts_.find({std::min(a, b), std::max(a, b)});
  if (found == pair_ghosts_.end() || found->second.in_use == own) return;
  found->second.in_use = own;
  fronts_.erase({found->first, GhostOf::First});
  fronts_.erase({found->first, GhostOf::Second});
}

void FrontStore::prepare_radial(const Executor& executor) {
  std::vector<FrontKey> near;
  for (std::uint32_t a = 0; a < solids_.size(); ++a)
    for (std::uint32_t b = a + 1; b < solids_.size(); ++b)
      if (solids_[a].revolution && solids_[b].revolution &&
          spheres_.gap(ComponentId(a), {}, {}, 0, ComponentId(b), Pose{}) <= 0)
        for (const GhostOf ghost : {GhostOf::None, GhostOf::First, GhostOf::Second})
          near.push_back({{ComponentId(a), ComponentId(b)}, ghost});
  std::vector<std::vector<ThreadMatch>> threads(near.size());
  executor.for_each_heavy(near.size(), [&](std::size_t i) {
    const auto& [pair, ghost] = near[i];
    const SolidTree& a = ghost == GhostOf::First ? ghosts_[pair.first.value] : solid(pair.first);
    const SolidTree& b = ghost == GhostOf::Second ? ghosts_[pair.second.value] : solid(pair.second);
    threads[i] = match_threads(*a.revolution, a.tree.origin, *b.revolution, b.tree.origin);
    PairMotion still;
    still.t0 = still.t1 = {{}, a.tree.origin - b.tree.origin};
    RadialSweeps(*a.revolution, a.tree.origin, *b.revolution, b.tree.origin, still).get();
  });
  for (std::size_t i = 0; i < near.size(); ++i)
    if (!threads[i].empty()) threads_[near[i]] = std::move(threads[i]);
}

CertificateFront FrontStore::new_front(ComponentId a, ComponentId b, GhostOf ghost) const {
  const SolidTree& of_a = ghost == GhostOf::First ? this->ghost(a, b) : solid(a);
  const SolidTree& of_b = ghost == GhostOf::Second ? this->ghost(b, a) : solid(b);
  // Matches name the threads of the first component first, and belong to the surfaces that they were found in.
  const auto own = pair_ghosts_.find({a, b});
  const bool matched = a < b && (own == pair_ghosts_.end() || !own->second.in_use);
  const auto threads = matched ? threads_.find({{a, b}, ghost}) : threads_.end();
  return {of_a.tree, of_b.tree, of_a.revolution.get(), of_b.revolution.get(),
          threads == threads_.end() ? Span<const ThreadMatch>{} : threads->second};
}

FrontStore::FrontKey FrontStore::key_of(ComponentId x, ComponentId y, GhostOf ghost) {
  if (x < y || ghost == GhostOf::None) return {{std::min(x, y), std::max(x, y)}, ghost};
  return {{y, x}, ghost == GhostOf::First ? GhostOf::Second : GhostOf::First};
}

CertificateFront& FrontStore::prepare(ComponentId moving, ComponentId fixed, GhostOf ghost, Span<const Pose> poses) {
  const FrontKey key = key_of(moving, fixed, ghost);
  auto found = fronts_.find(key);
  if (found == fronts_.end())
    found = fronts_.emplace(key, Entry{new_front(key.first.first, key.first.second, key.second), false, {}}).first;
  Entry& entry = found->second;
  const bool b_moves = moving > fixed;
  if (entry.b_moves != b_moves) {
    entry.front.exchange_roles();
    entry.b_moves = b_moves;
  } else if (!(entry.fixed_pose == poses[fixed.value])) {
    entry.front.forget();
  }
  entry.fixed_pose = poses[fixed.value];
  return entry.front;
}

const CertificateFront* FrontStore::find(ComponentId moving, ComponentId fixed, GhostOf ghost,
                                         const Pose& pose_fixed) const {
  const auto known = fronts_.find(key_of(moving, fixed, ghost));
  const bool usable =
      known != fronts_.end() && known->second.b_moves == (moving > fixed) && known->second.fixed_pose == pose_fixed;
  return usable ? &known->second.front : nullptr;
}

std::size_t FrontStore::size(const std::vector<bool>& is_moving) const {
  std::size_t size = 0;
  for (const auto& [key, entry] : fronts_)
    if (is_moving[key.first.first.value] != is_moving[key.first.second.value]) size += entry.front.size();
  return size;
}

}  // namespace dismantle
