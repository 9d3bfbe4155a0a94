// SPDX-License-Identifier: Apache-2.0
#include "bench/paper/paper_scenes.h"

#include "dismantle/engine/classify_pairs.h"
#include "dismantle/simplify/simplify_assembly.h"

namespace dismantle {

const std::vector<PaperAssembly>& paper_assemblies() {
  static const std::vector<PaperAssembly> kAssemblies = {
      {"microscope", 2900}, {"tooling", 5100}, {"lathe", 4300}, {"robot", 3800}};
  return kAssemblies;
}

Result<PaperScene> make_paper_scene(const PaperAssembly& assembly, const std::string& samples_folder) {
  Result<std::vector<BenchScene>> sample = make_bench_scenes(assembly.name, {}, samples_folder);
  if (!sample) return sample.error();
  PaperScene scene{sample->front(), sample->front()};
  Result<SimplifiedAssembly> simplified = simplify_assembly(scene.full.assembly, assembly.simplified);
  if (!simplified) return simplified.error();
  scene.simplified.assembly = std::move(simplified->assembly);
  ClassifyOptions options;
  options.executor = Executor(ExecutorKind::Threads);
  Result<PairStates> states = classify_pairs(scene.simplified.assembly, options);
  if (!states) return states.error();
  scene.simplified.states = std::move(*states);
  return scene;
}

Result<BenchScene> with_paper_pairs(const BenchScene& scene) {
  ClassifyOptions options;
  options.rule = ClassifyRule::Paper;
  options.executor = Executor(ExecutorKind::Threads);
  Result<PairStates> states = classify_pairs(scene.assembly, options);
  if (!states) return states.error();
  BenchScene made = scene;
  made.states = std::move(*states);
  return made;
}

}  // namespace dismantle
