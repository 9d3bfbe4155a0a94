// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/motion_scenes.h"

#include <string>
#include <vector>

namespace dismantle {

/// An assembly of table 1 of Du et al. 2015.
struct PaperAssembly {
  std::string name;            ///< Of our model of it.
  std::size_t simplified = 0;  ///< Size of the paper's simplified model [triangles].
};

/// The four assemblies of the table.
const std::vector<PaperAssembly>& paper_assemblies();

/// One of the four sample assemblies with its bundled motion, simplified to the paper's size and at full size.
struct PaperScene {
  BenchScene simplified, full;
};

/// Makes the scene of an assembly of the table from the files in `samples_folder`. Errors: those of reading and
/// simplifying.
Result<PaperScene> make_paper_scene(const PaperAssembly& assembly, const std::string& samples_folder);

/// The scene with the paper's pairs: those that touch or overlap when assembled are free until they have been apart
/// (S_i). Errors: those of classify_pairs().
Result<BenchScene> with_paper_pairs(const BenchScene& scene);

}  // namespace dismantle
