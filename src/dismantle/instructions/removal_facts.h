// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/pair_state.h"
#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/instructions/work_steps.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace dismantle {

/// Contact and clearance of a moving set along its removal path.
struct PathClearance {
  double contact_length = 0;  ///< Path length up to the last contact [mm].
  ComponentId last_contact;   ///< Component of the last contact; invalid without contact.
  /// Minimum distance to components other than `last_contact` after the last contact [mm]; infinite if none comes
  /// closer than kMaxClearanceShare of the set's size.
  double min_distance = std::numeric_limits<double>::infinity();
  ComponentId nearest;  ///< Component at that distance; invalid if there is none.
};

/// Evaluates removals with a collision engine: contact, clearance and components left unsupported.
class RemovalFacts {
 public:
  /// The assembly and the pairs must outlive this.
  RemovalFacts(const Assembly& assembly, const PairStates& pairs, const CertificateOptions& options);

  /// Contact and clearance, exact at kClearanceSamples poses per screw motion and not evaluated between them. Ignores
  /// embedded pairs and the components that earlier steps have removed.
  PathClearance clearance(const WorkStep& step, const RemovalMove& removal);
  /// Components that lose their support by a step: afterwards, but not before, they can translate down (-z) by
  /// kFallShare of their size. Components in a fit or embedded pair with a remaining one count as held.
  /// @param ground component that never falls
  std::vector<ComponentId> unsupported_after(const WorkStep& step, ComponentId ground);

 private:
  std::vector<Pose> with_removed(Span<const Pose> poses, Span<const ComponentId> removed) const;
  bool can_fall(ComponentId c, Span<const Pose> poses, Span<const ComponentId> removed);
  std::vector<ComponentId> neighbours(Span<const ComponentId> set) const;

  const Assembly& assembly_;
  const PairStates& pairs_;
  CertificateEngine engine_;
};

/// Samples per screw motion at which clearances are measured.
inline constexpr int kClearanceSamples = 12;
/// Translation downwards that counts as a fall, as a fraction of a component's size.
inline constexpr double kFallShare = 0.1;
/// Largest clearance that is reported, as a fraction of the size of the moving set.
inline constexpr double kMaxClearanceShare = 0.2;

/// The components that no step moves, the largest first.
std::vector<ComponentId> stationary_components(const Assembly& assembly, Span<const WorkStep> steps);

/// The overlaps of equal parts that a step moves with others, in the assembled state.
struct PartOverlaps {
  /// Overlaps with equal parts.
  struct With {
    std::size_t line = 0;                 ///< Line of the bill of materials.
    double least = 0;                     ///< The smallest depth [mm].
    double depth = 0;                     ///< The largest depth [mm].
    PairState state = PairState::Free;    ///< Overlapping, or Free.
    std::vector<ComponentId> components;  ///< Each once.
  };

  std::size_t line = 0;          ///< Line of the bill of materials.
  std::vector<ComponentId> own;  ///< Those that overlap others, each once.
  std::vector<With> with;        ///< In the order of the pairs.
};

/// The pairs that a step separates and that overlap, or that are free to, by the parts that the step moves.
/// @param lines of the bill of materials. Shape [component_count].
std::vector<PartOverlaps> overlaps_of(const WorkStep& step, const PairStates& pairs,
                                      const std::vector<std::size_t>& lines);

}  // namespace dismantle
