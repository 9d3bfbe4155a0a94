// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/paper/paper_methods.h"
#include "bench/paper/result_table.h"
#include "dismantle/core/result.h"

#include <functional>
#include <string>
#include <vector>

namespace dismantle {

/// The parts of the evaluation; each has a table of its own.
enum class EvaluationPart {
  Table1,   ///< The paper's method over the four assemblies at both sizes, with both kinds of pairs; on all counts of
            ///< cores and on a GPU.
  Figure9,  ///< All methods over the four assemblies at both sizes, on all counts of cores and on a GPU.
  Cores,    ///< The largest assembly on 1, 2, 4, ... cores.
  Sizes,    ///< A shaft in its hole with more and more triangles.
  Appends,  ///< Variants of appending to streams.
  Tunnels,  ///< Collisions that discrete steps miss.
};

/// All parts, in this order.
inline constexpr EvaluationPart kEvaluationParts[] = {EvaluationPart::Table1,  EvaluationPart::Figure9,
                                                      EvaluationPart::Cores,   EvaluationPart::Sizes,
                                                      EvaluationPart::Appends, EvaluationPart::Tunnels};

/// "table1", "figure9", ...: the name of the part's file and option.
std::string name_of(EvaluationPart part);

/// Settings of an evaluation.
struct EvaluationOptions {
  std::vector<int> cores{1};            ///< Counts of cores, ascending; parts with one count take the last.
  int repeats = 1;                      ///< Of each motion; the median time of each step counts.
  std::size_t moves = SIZE_MAX;         ///< Only the first ones of each motion.
  std::size_t largest = 1'000'000;      ///< Largest size in the curve over sizes [triangles].
  std::vector<std::string> assemblies;  ///< Only these of table 1 and figure 9; empty: all.
  std::string samples_folder;           ///< With the files and motions of the samples.
};

/// The results of a part. Times in ms of wall time.
struct EvaluationTable {
  ResultTable table;
  /// After every step of every motion the methods with elementary tests had the moving set at the same pose, and
  /// methods on a CUDA device had it where they had it on the CPU.
  bool equal_poses = true;
};

/// Measures a part and prints its rows as they are measured. Errors: those of reading the samples; Usage for an
/// assembly that is none of the four.
/// @param on_row called after each row with what there is so far
Result<EvaluationTable> evaluate(EvaluationPart part, const EvaluationOptions& options,
                                 const std::function<void(const EvaluationTable&)>& on_row);

}  // namespace dismantle
