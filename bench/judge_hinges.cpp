// SPDX-License-Identifier: Apache-2.0
// Do shafts turn in their bores? Of each assembly: the pairs of components that touch or overlap and have a common axis
// of cylinders that go all the way around. Each pair by itself turns a full turn in either direction, method
// `certificates`, response `touch`. By the oracle of soak_families the depth is measured around the whole turn.
//   judge_hinges [--tolerance MM] [--step DEGREES] [--poses N] ASSEMBLY...
// One row a pair, tab-separated, lengths in mm:
//   radius    the smaller one of the two components' greatest distances from the axis
//   start     depth in the assembled state (oracle)
//   deepest   greatest depth around the turn, the poses of the oracle not being those of the steps
//   forward, backward   degrees made; 360 where the target was reached
//   verdict   turns; stuck: nothing gets deeper by more than the tolerance, but not all was made; facets: the same
//   where
//             the depth rises by no more than two percent of the radius, as facets of different tessellations do;
//             blocked: a wrench, a key or a tooth is in the way
// Exit code 1 where a pair is stuck.
#include "bench/command_line.h"
#include "bench/families/depth_search.h"
#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/engine/classify_pairs.h"
#include "dismantle/features/revolution_axes.h"
#include "dismantle/loading/load_assembly.h"
#include "dismantle/math/angle.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

namespace dismantle::families {
namespace {

struct Settings {
  double tolerance = 0;  // 0: as of the assembly [mm]
  double step = 5;       // of the engine [degrees]
  int poses = 60;        // at which depths are searched for
};

/// How closely axes coincide that are taken for one: the sine of the angle, and tolerances.
constexpr double kParallel = 1e-4, kOnAxis = 5;
/// The least turn of a cylinder that goes all the way around.
constexpr double kAround = 0.95 * kTurn;
/// Depth that tessellation alone may add as cylinders turn in each other, as a share of the radius.
constexpr double kFacets = 0.02;

struct Axis {
  Vec3 point, direction;
  double turn = 0;
};

/// The axis about which both meshes have cylinders that go all the way around, and turn most.
std::optional<Axis> common_axis(const TriangleMesh& a, const TriangleMesh& b, double tolerance) {
  std::optional<Axis> best;
  const auto second = revolution_axes(b.vertices, b.faces);
  for (const RevolutionAxis& of_a : revolution_axes(a.vertices, a.faces))
    for (const RevolutionAxis& of_b : second) {
      const double turn = std::min(of_a.turn, of_b.turn);
      if (turn < kAround || (best && best->turn >= turn)) continue;
      if (length(cross(of_a.direction, of_b.direction)) > kParallel) continue;
      if (length(cross(of_a.direction, of_b.point - of_a.point)) > kOnAxis * tolerance) continue;
      best = Axis{of_a.point, of_a.direction, turn};
    }
  return best;
}

Pose turned(const Axis& axis, double degrees) {
  const Quat rotation = quat_about(axis.direction, degrees * kTurn / 360);
  return {axis.point - mat3_from_quat(rotation) * axis.point, rotation};
}

double radius_about(const Axis& axis, const TriangleMesh& mesh) {
  double radius = 0;
  for (const Vec3& p : mesh.vertices) radius = std::max(radius, length(cross(axis.direction, p - axis.point)));
  return radius;
}

/// @return degrees made before the first step that is not made whole
double turn(const Assembly& pair, const PairStates& states, const Axis& axis, double step) {
  CertificateEngine engine(pair, states);
  const ComponentId first(0);
  engine.grab({&first, 1});
  const int count = static_cast<int>(std::lround(360 / std::abs(step)));
  for (int k = 1; k <= count; ++k) {
    const Pose target = turned(axis, k * step);
    if (!(engine.step(target, ResponseKind::Touch).pose == target)) return (k - 1) * std::abs(step);
  }
  return 360;
}

/// @return false where a pair is stuck
bool judge(const Component& a, const Component& b, const Axis& axis, double tolerance, const Settings& settings) {
  Assembly pair;
  pair.components = {a, b};
  ClassifyOptions options;
  options.tolerance = tolerance;
  const Result<PairStates> states = classify_pairs(pair, options);
  if (!states) return true;
  const double forward = turn(pair, *states, axis, settings.step);
  const double backward = turn(pair, *states, axis, -settings.step);

  const TriangleMesh mesh_a = assembled_mesh(a), mesh_b = assembled_mesh(b);
  const double radius = std::min(radius_about(axis, mesh_a), radius_about(axis, mesh_b));
  const OracleMesh first(mesh_a, is_solid(mesh_a), false), second(mesh_b, is_solid(mesh_b), false);
  const double start = search_depth(first, second, {}, {0.02 * tolerance}).attained;
  double deepest = start;
  for (int k = 0; k < settings.poses; ++k) {
    const double degrees = 360 * (k + 0.382) / settings.poses;
    const FoundDepth found =
        search_depth(first, second, transform_from_pose(turned(axis, degrees)), {0.1 * tolerance, 4000, start});
    deepest = std::max(deepest, found.attained);
  }
  const double rise = deepest - start;
  const bool turns = forward == 360 && backward == 360;
  const bool stuck = !turns && rise <= tolerance;
  std::printf("%s\t%s\t%.3f\t%.6g\t%.6g\t%g\t%g\t%s\n", a.name.c_str(), b.name.c_str(), radius, start, deepest, forward,
              backward,
              turns                      ? "turns"
              : stuck                    ? "stuck"
              : rise <= kFacets * radius ? "facets"
                                         : "blocked");
  std::fflush(stdout);
  return !stuck;
}

int run(const std::string& file, const Settings& settings) {
  const Result<Assembly> assembly = load_assembly(file);
  if (!assembly) {
    std::fprintf(stderr, "judge_hinges: %s\n", assembly.error().message.c_str());
    return bench::kExitUnreadable;
  }
  ClassifyOptions options;
  options.tolerance = settings.tolerance;
  const Result<PairStates> states = classify_pairs(*assembly, options);
  if (!states) return bench::kExitUnreadable;
  std::printf("# %s, tolerance %g\n", assembly->source_file.c_str(), states->tolerance);
  int wrong = 0;
  for (const ComponentPair& p : states->pairs) {
    if (p.state != PairState::Contact && p.state != PairState::Overlapping) continue;
    const Component &a = (*assembly)[p.a], &b = (*assembly)[p.b];
    const std::optional<Axis> axis = common_axis(assembled_mesh(a), assembled_mesh(b), states->tolerance);
    if (axis && !judge(a, b, *axis, states->tolerance, settings)) wrong = 1;
  }
  return wrong;
}

}  // namespace
}  // namespace dismantle::families

int main(int argc, char** argv) {
  using namespace dismantle;
  families::Settings settings;
  std::vector<std::string> files;
  bench::CommandLine line("judge_hinges [--tolerance MM] [--step DEGREES] [--poses N] ASSEMBLY...");
  line.option("--tolerance", settings.tolerance);
  line.option("--step", settings.step);
  line.option("--poses", settings.poses, 1);
  line.words(files);
  if (!line.parse(argc, argv)) return bench::kExitUsage;
  if (files.empty() || !(settings.step > 0)) return line.wrong(), bench::kExitUsage;
  std::printf("moving\tfixed\tradius\tstart\tdeepest\tforward\tbackward\tverdict\n");
  int worst = 0;
  for (const std::string& file : files) worst = std::max(worst, families::run(file, settings));
  return worst;
}
