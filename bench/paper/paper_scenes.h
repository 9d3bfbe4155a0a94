// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/motion_scenes.h"

#include <string>
#include <vector>

namespace dismantle {

/// A row of table 1 of Du et al. 2015 (Tesla K20c, CUDA 5.5), for an assembly of that name and size [ms].
struct PaperRow {
  std::string assembly;
  std::size_t triangles = 0, simplified = 0;  ///< Of the paper's model; times are of the simplified one.
  double refit = 0, intersection = 0, overall = 0;
};

/// The rows of table 1, with the sizes from section 5.
const std::vector<PaperRow>& paper_table();

/// One of the four sample assemblies with its bundled motion, simplified to the paper's size and at full size.
struct PaperScene {
  PaperRow paper;
  BenchScene simplified, full;
};

/// Makes the scene of a row of the table from the files in `samples_folder`. Errors: those of reading and simplifying.
Result<PaperScene> make_paper_scene(const PaperRow& row, const std::string& samples_folder);

}  // namespace dismantle
