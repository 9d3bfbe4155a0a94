// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/paper/paper_methods.h"
#include "tests/support/tunnelling_scenes.h"

#include <string>
#include <vector>

namespace dismantle {

/// Single steps of one component past, into and through another; each starts where they are apart.
struct TunnelCase {
  std::string name;
  std::vector<scenes::OneStep> steps;
};

/// The cases: a cube through a plate much thinner than its step, and a shaft that leaves its housing in one step,
/// sideways through the wall or along the bore.
std::vector<TunnelCase> tunnel_cases();

/// Outcome of the steps of a case with a method.
struct TunnelCount {
  std::size_t steps = 0;
  std::size_t meeting = 0;      ///< Steps on which the two overlap more than allowed, by the audit.
  std::size_t tunnels = 0;      ///< Of these, steps that the method lets pass.
  std::size_t false_stops = 0;  ///< Steps that it stops although nothing is in the way.
};

/// A method with the guards and options that it has in the program.
struct TunnelMethod {
  std::string name;
  std::unique_ptr<MotionEngine> (*make)(const Assembly&, const PairStates&);
};

/// The discrete tests of boxes and of triangles, `streams` and `certificates`.
std::vector<TunnelMethod> tunnel_methods();

/// Counts for each method, in the order of the methods.
std::vector<TunnelCount> count_tunnels(const TunnelCase& tunnel_case, const std::vector<TunnelMethod>& methods);

}  // namespace dismantle
