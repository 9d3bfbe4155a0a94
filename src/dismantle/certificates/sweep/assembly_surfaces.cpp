// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/sweep/assembly_surfaces.h"

#include "dismantle/surface/ghost_surface.h"

#include <algorithm>
#include <set>
#include <utility>

namespace dismantle {

namespace {

/// Finds the mating threads of two trees and computes their radial bounds about the axes that are nearest to each other
/// in the assembled state.
std::vector<ThreadMatch> prepare_radial_of(const SolidTree& a, const SolidTree& b) {
  if (!a.revolution || !b.revolution) return {};
  PairMotion still;
  still.t0 = still.t1 = {{}, a.tree.origin - b.tree.origin};
  RadialSweeps(*a.revolution, a.tree.origin, *b.revolution, b.tree.origin, still).get();
  return match_threads(*a.revolution, a.tree.origin, *b.revolution, b.tree.origin);
}

}  // namespace

AssemblySurfaces::AssemblySurfaces(const Assembly& assembly, const PairStates& pairs, const CertificateOptions& options)
    : assembly_(assembly), pairs_(pairs), prepared_(options.prepared), shapes_(assembly_) {
  if (prepared_ && prepared_->tolerance() != tolerance()) prepared_ = nullptr;
  prepared_as_ = prepared_ ? find_prepared(*prepared_) : std::vector<ComponentId>(assembly_.components.size());
  prepare_components(options.executor);
  prepare_radial(options.executor);
  prepare_pairs(options);
  prepared_ = nullptr;
}

std::vector<ComponentId> AssemblySurfaces::find_prepared(const AssemblySurfaces& prepared) const {
  std::set<std::pair<const TriangleMesh*, std::uint32_t>> by_mesh;
  for (std::uint32_t c = 0; c < prepared.assembly_.components.size(); ++c)
    by_mesh.emplace(prepared.assembly_.components[c].mesh.get(), c);
  std::vector<ComponentId> found(assembly_.components.size());
  const auto find_from = [&](const Component& component, std::uint32_t from) -> ComponentId {
    for (auto known = by_mesh.lower_bound({component.mesh.get(), from});
         known != by_mesh.end() && known->first == component.mesh.get(); ++known)
      if (prepared.assembly_.components[known->second].assembly_from_mesh == component.assembly_from_mesh)
        return ComponentId(known->second);
    return {};
  };
  // In the same order, as far as possible: pairs of components in another order are prepared anew.
  std::uint32_t next = 0;
  for (std::size_t c = 0; c < found.size(); ++c) {
    const Component& component = assembly_.components[c];
    found[c] = find_from(component, next);
    if (!found[c].valid()) found[c] = find_from(component, 0);
    if (found[c].valid()) next = found[c].value + 1;
  }
  return found;
}

AssemblySurfaces::ComponentSurfaces AssemblySurfaces::prepare_component(const Component& component,
                                                                        const Executor& executor) const {
  const auto solid = std::make_shared<const SolidTree>(make_solid_tree(component, executor));
  // Sheets have no inside to retreat to.
  std::vector<Vec3> displaced = solid->vertices;
  if (solid->has_outside || solid->inside_out)
    displaced = ghost_vertices(displaced, outward_faces(solid->faces, solid->inside_out), kGhostLength * tolerance());
  const auto ghost = std::make_shared<const SolidTree>(make_displaced_tree(*solid, std::move(displaced), executor));
  const Aabb box = assembled_bounds(component);
  BoundingSphere sphere{box.empty() ? Vec3{} : box.center(), 0};
  for (const Vec3& p : solid->vertices) sphere.radius = std::max(sphere.radius, length(p - sphere.center));
  return {solid, ghost, sphere};
}

void AssemblySurfaces::prepare_components(const Executor& executor) {
  std::size_t all_faces = 0;
  for (const Component& c : assembly_.components) all_faces += c.mesh->faces.size();
  // Components that are more than a thread's share are built on all threads, the others side by side.
  const auto is_large = [&](const Component& c) {
    return c.mesh->faces.size() * static_cast<std::size_t>(executor.thread_count()) > all_faces;
  };
  components_.resize(assembly_.components.size());
  const auto prepare = [&](std::size_t c, const Executor& on) {
    const ComponentId known = prepared_as_[c];
    components_[c] =
        known.valid() ? prepared_->components_[known.value] : prepare_component(assembly_.components[c], on);
    if (known.valid()) shapes_.share(ComponentId(static_cast<std::uint32_t>(c)), prepared_->shapes_, known);
  };
  for (std::size_t c = 0; c < components_.size(); ++c)
    if (is_large(assembly_.components[c])) prepare(c, executor);
  executor.for_each_heavy(components_.size(), [&](std::size_t c) {
    if (!is_large(assembly_.components[c])) prepare(c, Executor{});
  });
  for (const ComponentSurfaces& c : components_) spheres_.add(c.sphere.center, c.sphere.radius);
}

void AssemblySurfaces::prepare_radial(const Executor& executor) {
  std::vector<FrontKey> near;
  for (std::uint32_t a = 0; a < components_.size(); ++a)
    for (std::uint32_t b = a + 1; b < components_.size(); ++b) {
      if (!components_[a].solid->revolution || !components_[b].solid->revolution) continue;
      if (spheres_.gap(ComponentId(a), {}, {}, 0, ComponentId(b), Pose{}) > 0) continue;
      const bool known = prepared_as_[a].valid() && prepared_as_[b].valid() && prepared_as_[a] < prepared_as_[b];
      for (const GhostOf ghost : {GhostOf::None, GhostOf::First, GhostOf::Second}) {
        const FrontKey key{{ComponentId(a), ComponentId(b)}, ghost};
        if (!known) {
          near.push_back(key);
          continue;
        }
        const Span<const ThreadMatch> threads = prepared_->threads({{prepared_as_[a], prepared_as_[b]}, ghost});
        if (!threads.empty()) threads_[key].assign(threads.begin(), threads.end());
      }
    }
  std::vector<std::vector<ThreadMatch>> threads(near.size());
  executor.for_each_heavy(near.size(), [&](std::size_t i) {
    const auto& [pair, of] = near[i];
    const SolidTree& a = of == GhostOf::First ? ghost(pair.first) : solid(pair.first);
    const SolidTree& b = of == GhostOf::Second ? ghost(pair.second) : solid(pair.second);
    threads[i] = prepare_radial_of(a, b);
  });
  for (std::size_t i = 0; i < near.size(); ++i)
    if (!threads[i].empty()) threads_[near[i]] = std::move(threads[i]);
}

void AssemblySurfaces::prepare_pairs(const CertificateOptions& options) {
  PairStates left{tolerance(), {}};
  // Guards whose search was ended are no worse than those of a search that would be ended as well.
  const bool is_ended = options.keep_going && !options.keep_going();
  if (is_ended) complete_ = false;
  for (const ComponentPair& pair : pairs_.pairs)
    if (!take_prepared(pair, is_ended)) left.pairs.push_back(pair);
  const KeepGoing keep_going = [&] {
    if (options.keep_going && !options.keep_going()) complete_ = false;
    return complete_.load();
  };
  std::vector<ComponentTrees> trees;
  for (const ComponentSurfaces& c : components_) trees.push_back({c.solid.get(), c.ghost.get()});
  add_guards(
      find_guards({&assembly_, &left, &shapes_, trees, options.executor, front_kernels(options.lanes), keep_going}),
      options.executor);
}

bool AssemblySurfaces::take_prepared(const ComponentPair& pair, bool incomplete_too) {
  const ComponentId a = prepared_as_[pair.a.value], b = prepared_as_[pair.b.value];
  if (!a.valid() || !b.valid() || !(a < b) || !(prepared_->complete_ || incomplete_too)) return false;
  const ComponentPair* known = prepared_->pairs_.find(a, b);
  if (!known || known->state != pair.state || known->depth != pair.depth || known->declared != pair.declared)
    return false;
  const auto guard = prepared_->guarded_.find({a, b});
  const bool guarded = guard != prepared_->guarded_.end();
  // A guard that was found for an allowance is found for the allowance that it gives as well.
  const bool same =
      known->allowed_depth == pair.allowed_depth || (guarded && guard->second.guard.allowed == pair.allowed_depth);
  if (same && guarded) guarded_.emplace(PairKey{pair.a, pair.b}, guard->second);
  return same;
}

void AssemblySurfaces::add_guards(std::vector<FoundGuard> guards, const Executor& executor) {
  std::vector<PairSurfaces> made(guards.size());
  executor.for_each_heavy(guards.size(), [&](std::size_t i) {
    FoundGuard& found = guards[i];
    made[i].guard = found.guard;
    if (found.ghosts[0].empty()) return;
    const ComponentId ids[] = {found.a, found.b};
    const auto make = [&](int k, std::vector<Vec3>& displaced) {
      return std::make_shared<const SolidTree>(make_displaced_tree(solid(ids[k]), std::move(displaced), Executor{}));
    };
    for (int k = 0; k < 2; ++k) {
      made[i].ghosts[k] = make(k, found.ghosts[k]);
      if (found.guard.sides.both) made[i].mirrored[k] = make(k, found.mirrored[k]);
    }
    const auto prepare = [](const SolidTree& a, const SolidTree& b) {
      return std::make_shared<const std::vector<ThreadMatch>>(prepare_radial_of(a, b));
    };
    made[i].threads[0] = prepare(*made[i].ghosts[0], solid(found.b));
    made[i].threads[1] = prepare(solid(found.a), *made[i].ghosts[1]);
  });
  for (std::size_t i = 0; i < guards.size(); ++i) guarded_[{guards[i].a, guards[i].b}] = std::move(made[i]);
}

const AssemblySurfaces::SharedTree* AssemblySurfaces::own_ghosts(const PairKey& pair) const {
  const auto found = guarded_.find(pair);
  return found == guarded_.end() || !found->second.ghosts[0] ? nullptr : found->second.ghosts;
}

Span<const ThreadMatch> AssemblySurfaces::threads(const FrontKey& key) const {
  const auto found = threads_.find(key);
  return found == threads_.end() ? Span<const ThreadMatch>{} : found->second;
}

Span<const ThreadMatch> AssemblySurfaces::own_threads(const FrontKey& key) const {
  const auto found = guarded_.find(key.first);
  if (found == guarded_.end() || (key.second != GhostOf::First && key.second != GhostOf::Second)) return {};
  const auto& threads = found->second.threads[key.second == GhostOf::First ? 0 : 1];
  return threads ? Span<const ThreadMatch>(*threads) : Span<const ThreadMatch>{};
}

}  // namespace dismantle
