// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/instructions/work_steps.h"

#include <limits>

namespace dismantle {

/// How near a removal comes to what it is taken from.
struct PathClearance {
  double touching = 0;  ///< It touches something until it has gone so far [mm]; all of the way where it never leaves.
  ComponentId touched;  ///< What it touches last; invalid where it touches nothing.
  /// After that, the least clearance where something else than what it touched last is nearest [mm]; infinite where
  /// nothing comes nearer than kNearShare of the set's size.
  double least = std::numeric_limits<double>::infinity();
  ComponentId nearest;  ///< To which; invalid where there is nothing.
};

/// Asks an engine what the removals of a timeline meet, and what they leave without support.
class RemovalFacts {
 public:
  /// The assembly and the pairs must outlive this.
  RemovalFacts(const Assembly& assembly, const PairStates& pairs, const CertificateOptions& options);

  /// Exact at places along the way, some kWayPieces for each screw; nothing is told in between. Embedded pairs, and
  /// what earlier steps have put aside, do not count.
  PathClearance clearance(const WorkStep& step, const RemovalMove& removal);
  /// What nothing holds from below once a step's sets are gone, though something did before: it could fall straight
  /// down by kFall of its size. What is in a fit or embedded with anything that is left holds by that. z is up.
  /// @param ground never falls
  std::vector<ComponentId> left_unsupported(const WorkStep& step, ComponentId ground);

 private:
  std::vector<Pose> with_gone(Span<const Pose> poses, Span<const ComponentId> gone) const;
  bool can_fall(ComponentId c, Span<const Pose> poses, Span<const ComponentId> gone);
  std::vector<ComponentId> neighbours(Span<const ComponentId> set) const;

  const Assembly& assembly_;
  const PairStates& pairs_;
  CertificateEngine engine_;
};

inline constexpr int kWayPieces = 12;
inline constexpr double kFall = 0.1;
inline constexpr double kNearShare = 0.2;

/// The components that stay: those that no step moves, the largest first.
std::vector<ComponentId> staying_components(const Assembly& assembly, Span<const WorkStep> steps);

}  // namespace dismantle
