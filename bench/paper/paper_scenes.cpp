// SPDX-License-Identifier: Apache-2.0
#include "bench/paper/paper_scenes.h"

#include "dismantle/engine/classify_pairs.h"
#include "dismantle/simplify/simplify_assembly.h"

namespace dismantle {

const std::vector<PaperRow>& paper_table() {
  static const std::vector<PaperRow> kRows = {{"microscope", 19'000, 2900, 9, 11, 20},
                                              {"tooling", 43'500, 5100, 14, 17, 31},
                                              {"lathe", 120'000, 4300, 13, 14, 27},
                                              {"robot", 43'000, 3800, 10, 12, 22}};
  return kRows;
}

Result<PaperScene> make_paper_scene(const PaperRow& row, const std::string& samples_folder) {
  Result<std::vector<BenchScene>> sample = make_bench_scenes(row.assembly, {}, samples_folder);
  if (!sample) return sample.error();
  PaperScene scene{row, sample->front(), sample->front()};
  Result<SimplifiedAssembly> simplified = simplify_assembly(scene.full.assembly, row.simplified);
  if (!simplified) return simplified.error();
  scene.simplified.assembly = std::move(simplified->assembly);
  Result<PairStates> states = classify_pairs(scene.simplified.assembly, {});
  if (!states) return states.error();
  scene.simplified.states = std::move(*states);
  return scene;
}

}  // namespace dismantle
