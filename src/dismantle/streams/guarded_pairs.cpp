// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/guarded_pairs.h"

#include "dismantle/certificates/front/certificate_kernels.h"
#include "dismantle/engine/chords.h"
#include "dismantle/geometry/aabb_corners.h"
#include "dismantle/surface/depth/swept_depth.h"
#include "dismantle/surface/ghost_surface.h"
#include "dismantle/surface/solid_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dismantle {

namespace {

/// Contacts of depths are found to within a motion of this share of the tolerance.
constexpr double kResolution = 0.25;

/// True if the two have no relative motion.
bool move_as_one(Span<const RigidTransform> start, Span<const RigidTransform> end, ComponentId a, ComponentId b) {
  const bool both_still = start[a.value] == end[a.value] && start[b.value] == end[b.value];
  return both_still || (start[a.value] == start[b.value] && end[a.value] == end[b.value]);
}

/// The displaced vertices that a component has against all others [mm, assembled].
std::vector<Vec3> usual_ghost(const Component& component, double max_length) {
  std::vector<Vec3> vertices = assembled_vertices(component);
  const MeshFaults& faults = component.faults;
  // Sheets have no inside to retreat to.
  if (faults.open_edges > 0) return vertices;
  return ghost_vertices(vertices, outward_faces(component.mesh->faces, faults.inside_out), max_length);
}

/// The displacement of a point of the moving shape [mm]: that of a corner of its box is the largest.
double max_displacement(const SweptPair& pair) {
  double longest = 0;
  for (const Vec3& corner : corners_of(pair.a->surface().bounds()))
    longest = std::max(longest, length(pair.end * corner - pair.start * corner));
  return longest;
}

/// The margin of a leaf whose corners are displaced by up to `length`: more than the rounding of positions.
float margin_of(double length, double tolerance) {
  if (length == 0) return 0;
  return std::nextafter(static_cast<float>(length * (1 + 1e-6) + 1e-7 * tolerance),
                        std::numeric_limits<float>::infinity());
}

}  // namespace

GuardedPairs::GuardedPairs(const Assembly& assembly, const PairStates& states, const AssemblyTriangles& triangles,
                           const CollisionOptions& options)
    : assembly_(assembly),
      tolerance_(states.tolerance),
      rules_(states),
      ghosts_{triangles.vertices, std::vector<float>(triangles.faces.size(), 0)} {
  make_usual_ghosts(states, triangles, options);
  find_own_ghosts(states, triangles, options.executor);
}

void GuardedPairs::make_usual_ghosts(const PairStates& states, const AssemblyTriangles& triangles,
                                     const CollisionOptions& options) {
  const std::size_t count = assembly_.components.size();
  // With the elementary test, ghosts are needed only for the pairs that are not apart in the assembled state.
  std::vector<std::uint8_t> has_ghost(count, options.test == ElementaryTest::Certified), touches(count, 0);
  for (const ComponentPair& pair : states.pairs) {
    if (pair.state == PairState::Clear || pair.state == PairState::Near) continue;
    has_ghost[pair.a.value] = has_ghost[pair.b.value] = 1;
    if (pair.state != PairState::Free) touches[pair.a.value] = touches[pair.b.value] = 1;
  }
  for (std::uint32_t c = 0; c < count; ++c)
    if (touches[c] != 0) solids_[ComponentId(c)];
  options.executor.for_each_heavy(count, [&](std::size_t i) {
    const ComponentId c(static_cast<std::uint32_t>(i));
    if (has_ghost[i] == 0) return;
    std::vector<Vec3> ghost = usual_ghost(assembly_[c], kGhostLength * tolerance_);
    displace(c, ghost, 0, triangles);
    if (touches[i] == 0) return;
    Solid& solid = solids_.at(c);
    solid.tree = make_solid_tree(assembly_[c], {});
    solid.ghost = make_displaced_tree(solid.tree, std::move(ghost), {});
  });
}

void GuardedPairs::find_own_ghosts(const PairStates& states, const AssemblyTriangles& triangles,
                                   const Executor& executor) {
  std::vector<ComponentTrees> trees(assembly_.components.size());
  for (const auto& [c, solid] : solids_) trees[c.value] = {&solid.tree, &solid.ghost};
  const LazyShapes shapes(assembly_);
  const GuardSearch search{&assembly_, &states, &shapes, trees, executor, front_kernels(widest_lanes())};
  for (const FoundGuard& found : find_guards(search)) {
    if (found.guard.guard == PairGuard::None) continue;  // EmbeddedPairs knows it
    Pair pair{found.a, found.b, found.guard, {PairTest::Certified}, {PairTest::Certified}};
    if (found.guard.guard == PairGuard::Depth) {
      pair.rule.test = PairTest::None;
      solids_.at(found.a).shape = shapes.of(found.a);
      solids_.at(found.b).shape = shapes.of(found.b);
    } else if (!found.ghosts[0].empty()) {
      const auto offset = [&](ComponentId c) {
        return static_cast<std::uint32_t>(ghosts_.displaced.size() - triangles.vertex_begin[c.value]);
      };
      const auto add = [&](const std::array<std::vector<Vec3>, 2>& ghosts, PairRule& rule) {
        rule.ghost_a = offset(found.a);
        add_own_ghost(found.a, ghosts[0], triangles);
        rule.ghost_b = offset(found.b);
        add_own_ghost(found.b, ghosts[1], triangles);
      };
      add(found.ghosts, pair.rule);
      if (found.guard.sides.both) add(found.mirrored, pair.mirrored);
    }
    rules_.set(pair.a, pair.b, pair.rule);
    pairs_.push_back(pair);
  }
}

/// Appends displaced vertices of a component [mm, in the order of its mesh].
void GuardedPairs::add_own_ghost(ComponentId c, const std::vector<Vec3>& displaced,
                                 const AssemblyTriangles& triangles) {
  const std::size_t begin = ghosts_.displaced.size();
  const Span<const Vec3> own = triangles.vertices_of(c);
  ghosts_.displaced.insert(ghosts_.displaced.end(), own.begin(), own.end());
  displace(c, displaced, begin - triangles.vertex_begin[c.value], triangles);
}

/// Sets the positions of a component's displaced vertices, from those in the order of its mesh, and the margins.
/// @param offset of the slots from those of the vertices
void GuardedPairs::displace(ComponentId c, Span<const Vec3> displaced, std::size_t offset,
                            const AssemblyTriangles& triangles) {
  const BvhComponent& range = triangles.bvh.components[c.value];
  const std::vector<Face>& mesh_faces = assembly_[c].mesh->faces;
  for (NodeIndex leaf = range.leaf_begin; leaf < range.leaf_end; ++leaf) {
    const Face& face = triangles.faces[leaf];
    const Face& in_mesh = mesh_faces[triangles.face_of[leaf].value];
    for (int k = 0; k < 3; ++k) {
      const Vec3 moved = displaced[in_mesh.v[k]];
      ghosts_.displaced[offset + face.v[k]] = moved;
      const double way = length(moved - triangles.vertices[face.v[k]]);
      ghosts_.margins[leaf] = std::max(ghosts_.margins[leaf], margin_of(way, tolerance_));
    }
  }
}

std::vector<ComponentPair> GuardedPairs::overlapping() const {
  std::vector<ComponentPair> list;
  for (const Pair& pair : pairs_)
    if (!pair.guard.parted) list.push_back({pair.a, pair.b, PairState::Overlapping, 0, 0, pair.guard.allowed});
  return list;
}

std::vector<BlockingPair> GuardedPairs::too_deep(Span<const RigidTransform> start,
                                                 Span<const RigidTransform> end) const {
  std::vector<BlockingPair> found;
  for (const Pair& pair : pairs_) {
    if (pair.guard.guard != PairGuard::Depth || pair.guard.parted || move_as_one(start, end, pair.a, pair.b)) continue;
    // In the frame of the component at rest, points move as the vertices of the streams do.
    const bool a_moves = !(start[pair.a.value] == end[pair.a.value]);
    const ComponentId moving = a_moves ? pair.a : pair.b, fixed = a_moves ? pair.b : pair.a;
    const auto seen = [&](Span<const RigidTransform> at) { return inverse(at[fixed.value]) * at[moving.value]; };
    const SweptPair swept{solids_.at(moving).shape.get(), solids_.at(fixed).shape.get(), seen(start), seen(end)};
    const double way = std::max(max_displacement(swept), tolerance_);
    const auto deep =
        first_deeper(swept, depth_limits(pair.guard, a_moves, tolerance_), kResolution * tolerance_ / way);
    if (!deep) continue;
    const FaceId of_moving(deep->face_a), of_fixed(deep->face_b);
    found.push_back({pair.a, pair.b, a_moves ? of_moving : of_fixed, a_moves ? of_fixed : of_moving, deep->free_until});
  }
  return found;
}

bool GuardedPairs::begin_motion(Span<const RigidTransform> start, Span<const RigidTransform> end) {
  bool changed = false;
  for (Pair& pair : pairs_) {
    if (!pair.guard.sides.both || pair.guard.parted || move_as_one(start, end, pair.a, pair.b)) continue;
    const RigidTransform first_as_seen = inverse(end[pair.b.value]) * end[pair.a.value];
    if (!pair.guard.sides.begin_motion(start[pair.a.value] == start[pair.b.value], first_as_seen, tolerance_)) continue;
    set_rule(pair);
    changed = true;
  }
  return changed;
}

bool GuardedPairs::part(Span<const RigidTransform> start, Span<const RigidTransform> end) {
  bool changed = false;
  for (Pair& pair : pairs_)
    if (!pair.guard.parted && !move_as_one(start, end, pair.a, pair.b) && apart(pair, end) &&
        usual_ghosts_apart(pair, end))
      changed = set_parted(pair, true) || changed;
  return changed;
}

bool GuardedPairs::jump(Span<const RigidTransform> state) {
  bool changed = false;
  for (Pair& pair : pairs_) {
    const bool moved = !(state[pair.a.value] == state[pair.b.value]);
    // A pair that has parted remains so where the ghost surfaces that all have do not meet.
    const bool parted = moved && (pair.guard.parted || apart(pair, state)) && usual_ghosts_apart(pair, state);
    if (pair.guard.sides.both &&
        pair.guard.sides.jump(!moved, inverse(state[pair.b.value]) * state[pair.a.value], tolerance_)) {
      set_rule(pair);
      changed = true;
    }
    changed = set_parted(pair, parted) || changed;
  }
  return changed;
}

/// @return true if that has changed
bool GuardedPairs::set_parted(Pair& pair, bool parted) {
  if (pair.guard.parted == parted) return false;
  pair.guard.parted = parted;
  set_rule(pair);
  return true;
}

void GuardedPairs::set_rule(const Pair& pair) {
  const PairRule& own = pair.guard.sides.mirrored ? pair.mirrored : pair.rule;
  rules_.set(pair.a, pair.b, pair.guard.parted ? PairRule{PairTest::Certified} : own);
}

const SolidShape& GuardedPairs::shape(ComponentId c) {
  std::shared_ptr<const SolidShape>& known = solids_.at(c).shape;
  if (!known) known = std::make_shared<const SolidShape>(assembly_[c]);
  return *known;
}

ComponentAt GuardedPairs::placed(ComponentId c, Span<const RigidTransform> state) {
  const Solid& solid = solids_.at(c);
  return {&solid.tree, &solid.ghost, state[c.value], [this, c] { return &shape(c); }};
}

bool GuardedPairs::apart(const Pair& pair, Span<const RigidTransform> state) {
  return further_apart(placed(pair.a, state), placed(pair.b, state), pair.guard.parting);
}

bool GuardedPairs::usual_ghosts_apart(const Pair& pair, Span<const RigidTransform> state) {
  return dismantle::usual_ghosts_apart(placed(pair.a, state), placed(pair.b, state), tolerance_);
}

}  // namespace dismantle
