// SPDX-License-Identifier: Apache-2.0
// Compares each assembly with copies of itself that are rotated at random, moved, and rounded to single precision, as
// STL files are: results should depend neither on orientation nor on rounding.
//   bench_orientations [--orientations N] ASSEMBLY...
// One row per assembly, tab-separated. pairs: pairs that touch or overlap and are guarded until they part, in any
// orientation. by_depth, by_depth_turned: pairs without ghost surfaces in the original, and the largest number in a
// copy. vary: pairs that have ghost surfaces in some orientations only; their names go to stderr. The times are
// processor time, of classifying all pairs and of preparing an engine; for the copies, the median.
#include "bench/assembly_input.h"
#include "bench/command_line.h"
#include "bench/timing.h"
#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/certificates/sweep/assembly_surfaces.h"
#include "dismantle/engine/classify_pairs.h"
#include "dismantle/math/angle.h"
#include "tests/support/random_scenes.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

namespace dismantle {
namespace {

struct Settings {
  int orientations = 4;
  std::vector<std::string> files;
};

/// An assembly turned and moved, its coordinates rounded to single precision.
Assembly turned(Assembly assembly, const Pose& pose) {
  const RigidTransform by = transform_from_pose(pose);
  for (Component& component : assembly.components) {
    TriangleMesh mesh = assembled_mesh(component);
    for (Vec3& p : mesh.vertices) {
      p = by * p;
      for (int i = 0; i < 3; ++i) p[i] = static_cast<double>(static_cast<float>(p[i]));
    }
    CleanedMesh cleaned = clean_mesh(mesh);
    component.mesh = std::make_shared<const TriangleMesh>(std::move(cleaned.mesh));
    component.faults = cleaned.faults;
    component.assembly_from_mesh = {};
  }
  return assembly;
}

/// The guards of an assembly in one orientation, and the time to prepare them.
struct Prepared {
  std::map<PairKey, PairGuard> guards;
  double classify_ms = 0, prepare_ms = 0;

  int by_depth() const {
    return static_cast<int>(
        std::count_if(guards.begin(), guards.end(), [](const auto& pair) { return pair.second == PairGuard::Depth; }));
  }
};

Prepared prepare(const Assembly& assembly, double tolerance) {
  Prepared result;
  ClassifyOptions options;
  options.tolerance = tolerance;
  const bench::Stopwatch classifying(bench::process_ns);
  const PairStates pairs = classify_pairs(assembly, options).value();
  result.classify_ms = classifying.ms();
  const bench::Stopwatch preparing(bench::process_ns);
  const CertificateEngine engine(assembly, pairs);
  result.prepare_ms = preparing.ms();
  for (const auto& [pair, surfaces] : engine.surfaces()->pairs()) result.guards[pair] = surfaces.guard.guard;
  return result;
}

/// Prints the row of an assembly.
void run(const std::string& file, const Assembly& assembly, int orientations) {
  const double tolerance = default_tolerance(assembly);
  std::vector<Prepared> all{prepare(assembly, tolerance)};
  std::mt19937_64 random(1);
  for (int i = 0; i < orientations; ++i)
    all.push_back(prepare(turned(assembly, scenes::random_pose(random, 100, kTurn / 2)), tolerance));
  std::map<PairKey, std::set<PairGuard>> guards;
  for (const Prepared& one : all)
    for (const auto& [pair, guard] : one.guards) guards[pair].insert(guard);
  int vary = 0, by_depth = 0;
  for (const auto& [pair, different] : guards) {
    if (different.size() < 2) continue;
    ++vary;
    std::fprintf(stderr, "  %s: '%s' and '%s' have ghost surfaces in some orientations only\n", file.c_str(),
                 assembly[pair.first].name.c_str(), assembly[pair.second].name.c_str());
  }
  std::vector<double> classify_ms, prepare_ms;
  for (auto one = all.begin() + 1; one != all.end(); ++one) {
    classify_ms.push_back(one->classify_ms);
    prepare_ms.push_back(one->prepare_ms);
    by_depth = std::max(by_depth, one->by_depth());
  }
  std::printf("%s\t%zu\t%d\t%d\t%d\t%.0f\t%.0f\t%.0f\t%.0f\n", file.c_str(), guards.size(), all[0].by_depth(), by_depth,
              vary, all[0].classify_ms, bench::quantile(classify_ms, 0.5), all[0].prepare_ms,
              bench::quantile(prepare_ms, 0.5));
  std::fflush(stdout);
}

}  // namespace
}  // namespace dismantle

int main(int argc, char** argv) {
  using namespace dismantle;
  Settings settings;
  bench::CommandLine line("bench_orientations [--orientations N] ASSEMBLY...");
  line.option("--orientations", settings.orientations, 1);
  line.words(settings.files);
  if (!line.parse(argc, argv) || settings.files.empty()) return bench::kExitUsage;
  std::printf(
      "assembly\tpairs\tby_depth\tby_depth_turned\tvary\tclassify_ms\tclassify_turned_ms\tprepare_ms\tprepare_turned_"
      "ms\n");
  for (const std::string& file : settings.files) {
    const Result<AssemblyFile> read = read_assembly_input(file);
    if (!read) {
      std::fprintf(stderr, "%s\n", read.error().message.c_str());
      return bench::kExitUnreadable;
    }
    run(file, read->assembly, settings.orientations);
  }
  return 0;
}
