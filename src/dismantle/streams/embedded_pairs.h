// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/streams/parting.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// One step of the whole assembly, as its embedded pairs are asked about it.
struct EmbeddedStep {
  const AssemblyTriangles* streams = nullptr;
  StepTriangles triangles;
  Span<const Kdop16> bounds;              ///< Of the whole step.
  Span<const RigidTransform> start, end;  ///< Of each component.
  double path_deviation = 0;              ///< How far a vertex's true path may be from the linear one [mm].
};

/// An embedded pair that parts within a step.
struct PartingPair {
  ComponentPair pair;
  double from = 0;                            ///< From this time of the step on it is like any other.
  std::vector<std::uint64_t> triangle_pairs;  ///< Those of S_t that belong to it.
};

/// The intersection stream S_i (Du et al. 2015, section 4.2): the pairs of components that may be in each other until
/// they part.
class EmbeddedPairs {
 public:
  EmbeddedPairs(const Assembly& assembly, const PairStates& states);

  const std::vector<ComponentPair>& pairs() const { return pairs_; }
  /// Whether any of them move against each other on the way from `start` to `end`, one transform a component.
  bool any_moves(Span<const RigidTransform> start, Span<const RigidTransform> end) const;
  /// The pairs that part within the step. They stay in the stream: the step may not be made.
  /// @param triangle_pairs S_t, ascending
  /// @param intersecting those of its embedded pairs that intersect at the end of the step (TID)
  std::vector<PartingPair> parting(const EmbeddedStep& step, Span<const std::uint64_t> triangle_pairs,
                                   Span<const std::uint64_t> intersecting) const;
  /// The pairs that are apart at the step's start.
  std::vector<ComponentPair> apart(const EmbeddedStep& step) const;
  /// These pairs have parted: they leave the stream for good.
  void part(const std::vector<ComponentPair>& parted);

 private:
  EmbeddedMotion motion(const ComponentPair& pair, const EmbeddedStep& step) const;

  double tolerance_;
  std::vector<bool> closed_;  // of each component: whether "inside" means something
  std::vector<Aabb> boxes_;   // of the components in the assembled state
  std::vector<ComponentPair> pairs_;
};

/// The triangle pairs that belong to components a < b, in the order given.
/// @param component_of of each leaf
std::vector<std::uint64_t> triangle_pairs_of(Span<const std::uint64_t> triangle_pairs,
                                             Span<const std::uint32_t> component_of, ComponentId a, ComponentId b);

}  // namespace dismantle
