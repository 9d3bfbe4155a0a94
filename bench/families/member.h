// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace dismantle::families {

/// One member of a family.
struct MemberKey {
  std::size_t family = 0;    ///< Index into kFamilies.
  std::uint64_t seed = 1;    ///< Of the run.
  std::uint64_t number = 0;  ///< Of the member.
};

/// How members are driven.
struct MemberOptions {
  int max_steps = 1000;        ///< Of its random motion.
  double engine_seconds = 20;  ///< The motion ends after so long.
  std::string dump;            ///< A folder in which the member is written; empty: it is not.
};

/// What became of a member.
struct MemberResult {
  int steps = 0;
  double slowest_ms = 0;   ///< Of a step.
  double depth_ratio = 0;  ///< Worst depth over the allowance.
  double passed_by = 0;    ///< 0, or what a ghost would need over the allowance.
  int beyond = 0, passed = 0, stuck = 0, straight = 0, errors = 0;
  std::size_t doubted = 0;
  double engine_seconds = 0, seconds = 0;
  std::string note;  ///< What failed.
};

/// Makes a member, drives it, and judges it.
/// @param report called with the name of each stage when it begins
MemberResult run_member(const MemberKey& key, const MemberOptions& options,
                        const std::function<void(const std::string&)>& report);

}  // namespace dismantle::families
