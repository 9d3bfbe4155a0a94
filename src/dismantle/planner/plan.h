// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace dismantle {

/// How a step was found.
enum class PlanTier {
  Straight,          ///< One component goes straight out.
  Helical,           ///< One component is screwed out along a thread.
  Sliding,           ///< One component is pushed and turned out, along what is in its way.
  Sampled,           ///< One component is moved out by a way that was found at random.
  StraightTogether,  ///< Several go straight out as one body.
};

/// "straight", "helical", "sliding", "sampled", "straight together": as reports have it.
std::string_view name_of(PlanTier tier);

/// A set of components leaves what it is part of, rigidly together.
struct PlanStep {
  static constexpr std::uint32_t kWhole = 0xffffffffu;

  std::vector<ComponentId> components;
  PlanTier tier = PlanTier::Straight;
  /// Index of the step that took the body away of which this set is a part; kWhole: of the assembly.
  std::uint32_t part_of = kWhole;
  /// From the assembled pose through these, each by one screw from the one before, and then straight on along `exit`
  /// for good. Relative to the body that the set is part of: as if that stood in its assembled pose.
  std::vector<Pose> poses;
  Vec3 exit;  ///< Unit.
};

/// What keeps a component from going straight out along one direction.
struct Blocker {
  ComponentId component;
  StraightContact contact;  ///< The first one with it.
};

/// Why a component does not come out: along the direction in which the fewest others are in its way.
struct Explanation {
  ComponentId component;
  Vec3 direction;                     ///< Unit.
  std::vector<Blocker> blockers;      ///< Nearest first. With these taken away it comes out along the direction.
  std::vector<ComponentId> together;  ///< The fewest that could go along the direction as one body; itself among them.
  std::vector<ComponentId> locked;    ///< Those that block each other along it: each of them needs all the others.
};

/// How an assembly comes apart.
struct Plan {
  std::vector<PlanStep> steps;  ///< In order. What a step takes away as one body is taken apart by the steps after it.
  std::vector<Explanation> staying;  ///< Of what should come out and does not.
  bool out_of_time = false;          ///< The time limit, or the user, ended the search early.
  double seconds = 0;                ///< Of the search.

  /// All that was asked for comes out.
  bool complete() const { return staying.empty() && !out_of_time; }
};

}  // namespace dismantle
