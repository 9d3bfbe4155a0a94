// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/streams/parting.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// One step of the whole assembly, as EmbeddedPairs takes it.
struct EmbeddedStep {
  const AssemblyTriangles* streams = nullptr;  ///< The assembled triangles and their hierarchy.
  StepTriangles triangles;                     ///< At the start and the end of the step.
  Span<const Kdop16> bounds;                   ///< Of the whole step, shape [node_count] [world].
  Span<const RigidTransform> start;            ///< World from assembled, shape [component_count].
  Span<const RigidTransform> end;              ///< World from assembled, shape [component_count].
  double path_deviation = 0;                   ///< Maximum distance of a vertex's true path from the linear one [mm].
};

/// A free pair that may part within a step.
struct PartingPair {
  ComponentPair pair;                         ///< As in the assembled state.
  double from = 0;                            ///< Earliest time of the step from which on it is tested like any other.
  double interval = 1;                        ///< Between that and later times of which the same may be true.
  std::vector<std::uint64_t> triangle_pairs;  ///< Those of S_t that belong to it.
};

/// The intersection stream S_i (Du et al. 2015, section 4.2): the pairs of components that may intersect until they
/// part.
class EmbeddedPairs {
 public:
  /// All free pairs of `states`, with all components in the assembled state.
  EmbeddedPairs(const Assembly& assembly, const PairStates& states);

  /// The pairs that are still free.
  const std::vector<ComponentPair>& pairs() const { return pairs_; }
  /// True if some pair has a relative motion between two states, one transform a component.
  bool any_moves(Span<const RigidTransform> start, Span<const RigidTransform> end) const;
  /// The pairs that part within the step. They stay in the stream, as the step may not be committed.
  /// @param triangle_pairs S_t, ascending
  /// @param intersecting those of its free pairs that intersect at the end of the step (TID)
  std::vector<PartingPair> parting(const EmbeddedStep& step, Span<const std::uint64_t> triangle_pairs,
                                   Span<const std::uint64_t> intersecting) const;
  /// The pairs that are apart at the start of the step.
  std::vector<ComponentPair> apart(const EmbeddedStep& step) const;
  /// Removes pairs that have parted, for good.
  void part(const std::vector<ComponentPair>& parted);

 private:
  EmbeddedMotion motion(const ComponentPair& pair, const EmbeddedStep& step) const;

  double tolerance_;
  std::vector<bool> closed_;  // of each component: its surface is closed
  std::vector<Aabb> boxes_;   // of the components in the assembled state
  std::vector<ComponentPair> pairs_;
};

/// The triangle pairs of components a < b, in the order given.
/// @param triangle_pairs keys of leaf pairs (pair_key)
/// @param component_of shape [leaf_count]
std::vector<std::uint64_t> triangle_pairs_of(Span<const std::uint64_t> triangle_pairs,
                                             Span<const std::uint32_t> component_of, ComponentId a, ComponentId b);

}  // namespace dismantle
