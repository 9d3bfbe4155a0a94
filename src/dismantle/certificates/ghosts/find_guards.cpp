// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/find_guards.h"

#include "dismantle/surface/depth/nowhere_deeper.h"
#include "dismantle/surface/depth/stays_whole.h"
#include "dismantle/surface/depth/thin_places.h"
#include "dismantle/surface/solid_distance.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

namespace dismantle {

namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
/// Edges at the border of an overlap are divided down to this share of its depth.
constexpr double kFinest = 1.0 / 16;
/// Surfaces that are nearer than this share of the tolerance may touch, as far as rounding can tell.
constexpr double kTouching = 1e-6;
/// Cylinders that turn in each other are allowed at least this share of their depth, and of the tolerance, more than
/// others: twice the accuracy to which the audit knows depths.
constexpr double kTurnsShare = 0.02, kTurns = 0.2;

/// The guard of a pair for which ghosts were searched; nothing where it needs none.
/// @param one_is_thick true if one of the two is a solid without walls thinner than twice a length [mm]
std::optional<FoundGuard> guard_of(const ComponentPair& pair, std::optional<PairGhosts> found, double tolerance,
                                   const std::function<bool(double)>& one_is_thick) {
  FoundGuard result{pair.a, pair.b, {PairGuard::Ghosts, pair.allowed_depth, {}, {}, kGhostLength * tolerance}, {}};
  GuardedPair& guard = result.guard;
  guard.parting = tolerance;
  if (!found) {
    guard.guard = PairGuard::Depth;
    guard.allowed = std::max(guard.allowed, pair.depth + tolerance);
    return result;
  }
  if (found->max_length == 0) return std::nullopt;
  guard.displaced = found->max_length;
  if (found->turning > 0) {
    guard.parting = std::max(guard.allowed, found->turning + tolerance);
    // The path says by its allowance that facets come apart and meet again, also where they are deepest at the start.
    guard.allowed = std::max(guard.parting, guard.allowed + std::max(kTurnsShare * pair.depth, kTurns * tolerance));
  } else if (found->retracted || one_is_thick(found->max_length))
    // Thin parts and sheets may have passed each other by less than their allowance, but not the middle of a wall that
    // no displacement gets past.
    guard.parting = kApartShare * tolerance;
  result.ghosts = std::move(found->vertices);
  return result;
}

/// One of two components whose depth is bounded.
struct BoundedSide {
  const SolidTree& tree;
  const SolidShape& shape;
};

/// Where the depth of a pair does not keep points from passing through a solid, limits that of those that do not
/// overlap it. @param far_allowed their depth [mm] @param depth of the pair [mm]
void limit_far_points(GuardedPair& guard, const BoundedSide& a, const BoundedSide& b, double far_allowed, double depth,
                      double tolerance) {
  const double limit = guard.allowed - kArcShare * tolerance;
  const auto limit_in = [&](const BoundedSide& outer, const BoundedSide& inner, std::size_t of_inner) {
    const bool is_less = far_allowed < guard.allowed;
    const bool is_limit = is_less ? !outer.shape.thin_places(limit).none() : is_nowhere_deeper(outer.shape, limit);
    guard.far_allowed[of_inner] = is_limit ? far_allowed : kUnlimited;
    if (!is_limit) return;
    const double finest = std::max(tolerance, kFinest * depth);
    guard.hole_for[of_inner] = stays_whole(outer.tree.vertices, outer.tree.faces, inner.shape, finest);
  };
  limit_in(b, a, 0);
  limit_in(a, b, 1);
}

}  // namespace

DepthLimits depth_limits(const GuardedPair& pair, bool a_first, double tolerance) {
  const double arcs = kArcShare * tolerance;
  const double of_first = pair.far_allowed[0] - arcs, of_second = pair.far_allowed[1] - arcs;
  const auto in_order = [&](const auto& two) { return a_first ? two : std::array{two[1], two[0]}; };
  const auto far = in_order(std::array{of_first, of_second});
  const auto hole = in_order(pair.hole_for);
  return {pair.allowed - arcs, far[0], far[1], hole[0], hole[1]};
}

std::vector<FoundGuard> find_guards(const GuardSearch& search) {
  const double tolerance = search.pairs->tolerance;
  const auto trees = [&](ComponentId c) -> const ComponentTrees& { return search.trees[c.value]; };
  std::vector<ComponentPair> pairs;
  for (const ComponentPair& pair : search.pairs->pairs) {
    if (pair.state == PairState::Clear || pair.state == PairState::Near) continue;
    const bool faces = !search.assembly->components[pair.a.value].mesh->faces.empty() &&
                       !search.assembly->components[pair.b.value].mesh->faces.empty();
    if (faces) pairs.push_back(pair);
  }
  const LazyShapes& shapes = *search.shapes;
  std::vector<std::optional<FoundGuard>> guards(pairs.size());
  search.executor.for_each_heavy(pairs.size(), [&](std::size_t i) {
    const ComponentPair& pair = pairs[i];
    if (pair.state == PairState::Free) {
      guards[i] = FoundGuard{pair.a, pair.b, {PairGuard::None, kUnlimited, {}, {}, 0, tolerance}, {}};
      return;
    }
    const bool solids = trees(pair.a).solid->has_outside && trees(pair.b).solid->has_outside;
    const double declared = std::max(0.0, pair.declared - tolerance);
    const auto side = [&](ComponentId c) {
      return OverlapSide{trees(c).solid, [&shapes, c]() -> const SolidShape& { return *shapes.of(c); }};
    };
    const PairGhostRequest request{
        side(pair.a), side(pair.b), trees(pair.a).ghost, trees(pair.b).ghost, std::max(pair.depth, declared),
        declared,     tolerance,    search.kernels};
    // Corners of ghosts could not be displaced by as much as is declared.
    const bool stopped = search.keep_going && !search.keep_going();
    const bool by_depth = solids && (pair.declared > 0 || stopped);
    const auto one_is_thick = [&](double length) {
      // Not kept with the shape: each pair has a length of its own.
      const auto has_no_thin_place = [&](ComponentId c) {
        return trees(c).solid->has_outside && ThinPlaces(*shapes.of(c), length).none();
      };
      return has_no_thin_place(pair.b) || has_no_thin_place(pair.a);
    };
    std::optional<PairGhosts> ghosts = by_depth ? std::nullopt : find_pair_ghosts(request);
    std::optional<MirroredGhosts> mirrored = ghosts ? mirrored_ghosts(request, *ghosts) : std::nullopt;
    guards[i] = guard_of(pair, std::move(ghosts), tolerance, one_is_thick);
    if (guards[i] && mirrored) {
      guards[i]->guard.sides = mirrored->sides;
      guards[i]->mirrored = std::move(mirrored->vertices);
    }
    if (!guards[i] || guards[i]->guard.guard != PairGuard::Depth) return;
    FoundGuard& found = *guards[i];
    const double far_allowed = pair.declared > 0 ? found.guard.allowed : tolerance;
    const BoundedSide a{*trees(pair.a).solid, *shapes.of(pair.a)}, b{*trees(pair.b).solid, *shapes.of(pair.b)};
    limit_far_points(found.guard, a, b, far_allowed, pair.depth, tolerance);
    // Walls of both are thicker than the displacements of usual ghosts, which are on the sides of their faces then.
    const double displaced = kGhostLength * tolerance;
    if (a.shape.thin_places(displaced).none() && b.shape.thin_places(displaced).none())
      found.guard.parting = kApartShare * tolerance;
  });
  std::vector<FoundGuard> found;
  for (std::optional<FoundGuard>& guard : guards)
    if (guard) found.push_back(std::move(*guard));
  return found;
}

bool usual_ghosts_apart(const ComponentAt& a, const ComponentAt& b, double tolerance) {
  const auto touch = [&](const SolidTree* first, const SolidTree* second) {
    if (first->tree.empty() || second->tree.empty()) return false;
    const SolidDistance found = solid_distance({first, a.world_from_assembled}, {second, b.world_from_assembled},
                                               limit_including(kTouching * tolerance));
    return found.distance <= kTouching * tolerance;
  };
  return !touch(a.ghost, b.solid) && !touch(a.solid, b.ghost);
}

bool further_apart(const ComponentAt& a, const ComponentAt& b, double distance) {
  const PlacedSolid first{a.solid, a.world_from_assembled}, second{b.solid, b.world_from_assembled};
  if (a.solid->tree.empty() || b.solid->tree.empty() || bounds_distance(first, second) > distance) return true;
  return solid_distance(first, second, limit_including(distance)).distance > distance && none_inside(a, b);
}

bool none_inside(const ComponentAt& a, const ComponentAt& b) {
  const PlacedSolid first{a.solid, a.world_from_assembled}, second{b.solid, b.world_from_assembled};
  if (a.solid->tree.empty() || b.solid->tree.empty() || bounds_distance(first, second) > 0) return true;
  const auto inside = [](const ComponentAt& inner, const ComponentAt& outer) {
    const RigidTransform outer_from_inner = inverse(outer.world_from_assembled) * inner.world_from_assembled;
    const WindingNumber& winding = outer.make_shape()->winding();
    // A connected part that does not meet a closed surface is on one side of it.
    const std::vector<Vec3>& points = winding.fans() ? inner.solid->vertices : inner.make_shape()->shell_points();
    return std::any_of(points.begin(), points.end(), [&](Vec3 p) { return winding.inside(outer_from_inner * p); });
  };
  return !inside(a, b) && !inside(b, a);
}

}  // namespace dismantle
