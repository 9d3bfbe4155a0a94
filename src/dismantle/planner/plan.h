// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/joints/joint.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace dismantle {

/// The kind of motion of a step.
enum class PlanTier {
  Straight,          ///< One component moves straight out.
  Helical,           ///< One component is unscrewed along a thread.
  Sliding,           ///< One component slides and turns out along the contacts.
  Sampled,           ///< One component follows a path found by random sampling.
  StraightTogether,  ///< Several move straight out as one body.
};

/// "straight", "helical", "sliding", "sampled", "straight together": as in reports.
std::string_view name_of(PlanTier tier);

/// By how much all surfaces could grow before the motion of a step would not be free.
struct StepMargin {
  double margin = 0;    ///< Half the smallest distance to components that are not touched in the assembled state [mm].
  ComponentId nearest;  ///< The component at that distance; invalid if nothing is near.
};

/// The removal of a set of components from the body that they belong to, as one rigid body.
struct PlanStep {
  /// Value of part_of for the whole assembly.
  static constexpr std::uint32_t kWhole = 0xffffffffu;

  std::vector<ComponentId> components;  ///< The set that moves.
  PlanTier tier = PlanTier::Straight;   ///< How it moves.
  /// Index of the step that removed the body to which this set belongs; kWhole: the assembly.
  std::uint32_t part_of = kWhole;
  /// The path: from the assembled pose through these poses, one screw motion each, then straight along `exit`. Relative
  /// to the body that the set belongs to, as if that were in its assembled pose.
  std::vector<Pose> poses;
  Vec3 exit;                           ///< Unit direction of the last, straight part.
  std::optional<StepMargin> margin{};  ///< After find_margins().
  /// How a fastener is turned out of its thread meanwhile: one that comes out along its axis, and is in the thread. The
  /// path itself may be straight.
  std::optional<Unscrewing> unscrewing{};
  /// Fasteners that still hold some of the components when they move; for a fastener that is pulled across its axis,
  /// what it is screwed into. Ascending; empty unless there was no other step.
  std::vector<ComponentId> still_held_by{};
  /// Others enclose all of its components, none of which is a fastener, when they are removed (Exposure): they come out
  /// through an opening.
  bool is_enclosed = false;
};

/// A component that blocks the straight removal of another along one direction.
struct Blocker {
  ComponentId component;    ///< The blocking component.
  StraightContact contact;  ///< The first contact with it.
};

/// The overlap that a pair of components would have to be allowed.
struct NeededOverlap {
  ComponentId moving;  ///< One of those that move.
  ComponentId fixed;   ///< The one that blocks it.
  double depth = 0;    ///< Depth that would have to be allowed until the two have been apart [mm].
  double more = 0;     ///< By how much that is more than what is allowed now [mm].
  Vec3 at;             ///< Where they meet first without it [mm, assembly frame].
};

/// A straight way out, and what would have to be allowed for it.
struct LeastOverlap {
  Vec3 direction;                    ///< Unit.
  double more = 0;                   ///< The largest one of the pairs' [mm].
  std::vector<NeededOverlap> pairs;  ///< All pairs that block, the one that needs the most first.
};

/// Why a component cannot be removed: along the direction with the fewest blockers.
struct Explanation {
  ComponentId component;           ///< The component that stays; of a group, the largest.
  std::vector<ComponentId> group;  ///< The components of its group, including itself.
  Vec3 direction;                  ///< Unit.
  std::vector<Blocker> blockers;   ///< Nearest first. Once they are gone it can be removed along the direction.
  std::vector<ComponentId>
      together;  ///< The smallest set that could move along the direction as one body, including itself.
  std::vector<ComponentId> locked;  ///< Components that block each other along it (a strongly connected set).
  std::optional<LeastOverlap>
      overlap;  ///< What would have to be allowed for it to come out, where that was searched for.
};

/// A disassembly sequence.
struct Plan {
  std::vector<PlanStep> steps;            ///< In order. A body that a step removes is taken apart by later steps.
  std::vector<Explanation> staying;       ///< For each component that should be removed and cannot.
  bool out_of_time = false;               ///< The time limit or the user ended the search early.
  bool effort_spent = false;              ///< More effort may free components that stay (PlanOptions).
  std::vector<ComponentPair> allowances;  ///< Of pairs that may be deeper than the tolerance, by the engine.
  double seconds = 0;                     ///< Duration of the search.
  std::vector<Joint> joints{};            ///< That the order follows; empty with FastenerOrder::Ignored.

  /// True if everything that was asked for can be removed.
  bool complete() const { return staying.empty() && !out_of_time; }
};

}  // namespace dismantle
