// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/paper/paper_methods.h"
#include "tests/support/tunnelling_scenes.h"

#include <string>
#include <vector>

namespace dismantle {

/// Single steps of one component past, into and through another, each from a place where both are apart.
struct TunnelCase {
  std::string name;
  std::vector<scenes::OneStep> steps;
};

/// A cube through a plate of a tenth of its step's length and less, and a shaft that is torn out of its housing in one
/// step, sideways through the wall or along the bore.
std::vector<TunnelCase> tunnel_cases();

/// How the steps of a case came out with a method.
struct TunnelCount {
  std::size_t steps = 0;
  std::size_t meeting = 0;      ///< Steps on whose way the two are deeper in each other than allowed: by the audit.
  std::size_t tunnels = 0;      ///< Those of them that the method lets through.
  std::size_t false_stops = 0;  ///< Steps that it stops although nothing is on the way.
};

/// A method as a user has it: with the guards and options that it has in the program.
struct TunnelMethod {
  std::string name;
  std::unique_ptr<MotionEngine> (*make)(const Assembly&, const PairStates&);
};

/// The discrete tests of boxes and of triangles, and our two methods.
std::vector<TunnelMethod> tunnel_methods();

/// Counts for each method, in their order.
std::vector<TunnelCount> count_tunnels(const TunnelCase& tunnel_case, const std::vector<TunnelMethod>& methods);

}  // namespace dismantle
