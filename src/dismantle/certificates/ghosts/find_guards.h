// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/certificates/ghosts/find_pair_ghosts.h"
#include "dismantle/certificates/ghosts/sheet_sides.h"
#include "dismantle/core/keep_going.h"
#include "dismantle/exec/executor.h"
#include "dismantle/surface/depth/swept_depth.h"

#include <array>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace dismantle {

/// The way in which two components are kept from getting deeper into each other.
enum class PairGuard : std::uint8_t {
  Ghosts,  ///< Ghost surfaces that never cross the other component.
  Depth,   ///< None were found for the overlap: the depth of the two solids is bounded.
  None,    ///< Not at all, until they have been apart.
};

/// Two components that have been given an allowance of their own.
struct GuardedPair {
  PairGuard guard = PairGuard::Ghosts;  ///< Until they have been apart.
  double allowed = 0;                   ///< Depth allowed until then [mm]; infinite without a guard.
  /// As DepthLimits::far_a and far_b, without the share of arcs; with PairGuard::Depth only [mm].
  std::array<double, 2> far_allowed{};
  /// As DepthLimits::hole_for_a and hole_for_b.
  std::array<bool, 2> hole_for{};
  double displaced = 0;  ///< Largest displacement of their own ghosts [mm].
  double parting = 0;    ///< They have been apart where they are further apart than this [mm].
  bool parted = false;   ///< They have been apart: they are treated like any other pair.
  FaceId near_a{0};      ///< A face that was near `near_b` when last looked for; any before.
  FaceId near_b{0};      ///< Of the other component.
  SheetSides sides{};    ///< Of two sheets that touch.
};

/// Solids that are further apart than this share of the tolerance have been apart, a bit less than the audit's tenth;
/// two thin parts or sheets, and thin parts whose depth is bounded, where they are further apart than the tolerance.
/// Cylinders that turn in each other have to be further apart than their allowance, as facets that happen to be apart
/// meet again.
inline constexpr double kApartShare = 0.08;

/// The limits of a pair whose depth is bounded, less the share of the tolerance that arcs have, which is kept for
/// translations as well: a rotation may follow. @param a_first SweptPair::a is the component with the smaller id
DepthLimits depth_limits(const GuardedPair& pair, bool a_first, double tolerance);

/// The trees of a component in the assembled state.
struct ComponentTrees {
  const SolidTree* solid = nullptr;  ///< Null for components that touch or overlap no other one.
  const SolidTree* ghost = nullptr;  ///< The ghost surface that it has against all others; null as `solid` is.
};

/// The guard of two components a < b.
struct FoundGuard {
  ComponentId a;      ///< The component with the smaller id.
  ComponentId b;      ///< The other one.
  GuardedPair guard;  ///< Not parted.
  /// Displaced vertices of `a` and `b` where they have ghosts of their own [mm, assembled]; else both are empty.
  std::array<std::vector<Vec3>, 2> ghosts;
  /// The same on the other sides of two sheets; empty unless GuardedPair::sides has both.
  std::array<std::vector<Vec3>, 2> mirrored{};
};

/// The shapes of an assembly's components, each built when it is first wanted, by any thread.
class LazyShapes {
 public:
  /// @param assembly must outlive this
  explicit LazyShapes(const Assembly& assembly) : assembly_(assembly), shapes_(assembly.components.size()) {
    for (auto& shape : shapes_) shape = std::make_shared<Lazy>();
  }

  /// The shape of a component. @param executor builds it
  const std::shared_ptr<const SolidShape>& of(ComponentId c, const Executor& executor = {}) const {
    Lazy& lazy = *shapes_[c.value];
    std::call_once(lazy.once, [&] { lazy.shape = std::make_shared<const SolidShape>(assembly_[c], executor); });
    return lazy.shape;
  }
  /// Shares the shape of a component with a component of other shapes. @pre both have the same mesh in the same place
  void share(ComponentId c, const LazyShapes& others, ComponentId other) {
    shapes_[c.value] = others.shapes_[other.value];
  }

 private:
  struct Lazy {
    std::once_flag once;
    std::shared_ptr<const SolidShape> shape;
  };
  const Assembly& assembly_;
  std::vector<std::shared_ptr<Lazy>> shapes_;
};

/// The components whose guards are wanted.
struct GuardSearch {
  const Assembly* assembly = nullptr;  ///< Never null.
  const PairStates* pairs = nullptr;   ///< Of the assembled state; never null.
  const LazyShapes* shapes = nullptr;  ///< Of the components; never null.
  Span<const ComponentTrees> trees;    ///< Shape [component_count].
  Executor executor;                   ///< Runs the pairs; the result does not depend on it.
  FrontKernels kernels;                ///< Any.
  KeepGoing keep_going = {};           ///< Once it returns false, the depth of pairs that are left is bounded.
};

/// The guards of the pairs that touch or overlap in the assembled state, ordered by (a, b), except for those that are
/// apart by the ghosts that components have against all others, and have no allowance of their own.
std::vector<FoundGuard> find_guards(const GuardSearch& search);

/// A component at a pose.
struct ComponentAt {
  const SolidTree* solid = nullptr;               ///< Never null.
  const SolidTree* ghost = nullptr;               ///< The ghost surface that it has against all others; never null.
  RigidTransform world_from_assembled;            ///< The pose.
  std::function<const SolidShape*()> make_shape;  ///< Its shape; called if the surfaces are apart.
};

/// True if two components are further apart than `distance` [mm], and no vertex of one is inside the other.
bool further_apart(const ComponentAt& a, const ComponentAt& b, double distance);

/// True if no vertex of one of two components is inside the other. @pre their surfaces do not meet
bool none_inside(const ComponentAt& a, const ComponentAt& b);

/// True if the ghost surface that each of two components has against all others does not meet the other component, so
/// that the two can be treated like any other pair. @param tolerance [mm]
bool usual_ghosts_apart(const ComponentAt& a, const ComponentAt& b, double tolerance);

}  // namespace dismantle
