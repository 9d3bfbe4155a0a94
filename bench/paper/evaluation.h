// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/paper/paper_methods.h"
#include "bench/paper/result_table.h"
#include "bench/paper/svg_chart.h"
#include "dismantle/core/result.h"

#include <string>
#include <vector>

namespace dismantle {

/// What is measured, how often and how large.
struct EvaluationOptions {
  int cores = 1;                    ///< The most that methods get; the curve over cores goes from 1 to this.
  int repeats = 1;                  ///< Of each motion; of every step the least time counts.
  std::size_t largest = 1'000'000;  ///< Triangles that the curve over sizes goes up to.
  std::string samples_folder;
};

/// Everything that the evaluation measured. Times in ms, means over the steps of a motion.
struct Evaluation {
  ResultTable steps;     ///< Every assembly, size and method on all cores: table 1 and more.
  ResultTable speed_up;  ///< Figure 9: how many times as long the front-based baseline takes.
  ResultTable stages;    ///< The full assemblies stage by stage: where the difference comes from.
  ResultTable cores;     ///< One assembly on 1 to all cores.
  ResultTable sizes;     ///< A shaft in its hole, of more and more triangles.
  ResultTable appends;   ///< Ways of appending to streams.
  ResultTable tunnels;   ///< What discrete steps let through.
  /// The least that *streams (elementary)* is faster than the baseline by: of the assemblies, and of the shafts.
  double least_speed_up = 1e300, least_speed_up_of_shafts = 1e300;
  BarChart speed_up_chart;
  LineChart core_chart, size_chart;
  /// After every step of every motion the methods with elementary tests had the set in hand at the same pose, and those
  /// on a CUDA device where they had it on the CPU.
  bool equal_poses = true;
};

/// Measures everything; prints rows as they come. Errors: those of reading the samples.
Result<Evaluation> evaluate(const EvaluationOptions& options);

}  // namespace dismantle
