// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/paper/paper_methods.h"
#include "bench/paper/result_table.h"
#include "bench/paper/svg_chart.h"
#include "dismantle/core/result.h"

#include <string>
#include <vector>

namespace dismantle {

/// Settings of an evaluation.
struct EvaluationOptions {
  int cores = 1;                    ///< Cores of the methods; the curve over cores goes from 1 to this.
  int repeats = 1;                  ///< Of each motion; the shortest time of each step counts.
  std::size_t largest = 1'000'000;  ///< Largest size in the curve over sizes [triangles].
  std::string samples_folder;       ///< With the STEP files and motions of the samples.
};

/// Results of an evaluation. Times in ms, means over the steps of a motion.
struct Evaluation {
  ResultTable steps;     ///< Every assembly, size and method on all cores; contains table 1.
  ResultTable speed_up;  ///< Figure 9: time of the front-based baseline over that of the method.
  ResultTable stages;    ///< The full assemblies, stage by stage.
  ResultTable cores;     ///< One assembly on 1 to all cores.
  ResultTable sizes;     ///< A shaft in its hole with increasing numbers of triangles.
  ResultTable appends;   ///< Variants of appending to streams.
  ResultTable tunnels;   ///< Collisions that discrete steps miss.
  /// The smallest speed-up of *streams (elementary)* over the baseline: of the assemblies, and of the shafts.
  double min_speed_up = 1e300, min_speed_up_of_shafts = 1e300;
  BarChart speed_up_chart;
  LineChart core_chart, size_chart;
  /// After every step of every motion the methods with elementary tests had the moving set at the same pose, and
  /// methods on a CUDA device had it where they had it on the CPU.
  bool equal_poses = true;
};

/// Measures everything and prints the rows as they are measured. Errors: those of reading the samples.
Result<Evaluation> evaluate(const EvaluationOptions& options);

}  // namespace dismantle
