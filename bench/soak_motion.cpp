// SPDX-License-Identifier: Apache-2.0
// Random drags over assemblies with the method `certificates` and response `slide`, every path audited.
//   soak_motion [--steps N] [--seed N] [--threads N] [--targets N] [--audit-seconds S] [--keep FOLDER] [ASSEMBLY...]
// Without names: the samples and every assembly of the data folder beside the repository. A batch starts in the
// assembled state and drags a few random components one after another, in random directions, by a trembling hand that
// ignores obstacles. Then the last component is tested for being stuck: where the audit finds a short straight motion
// free with nine tenths of every allowance, the engine must make nine tenths of it.
// One row an assembly, tab-separated; exit code 1 where an audit found a violation or a component was stuck.
// audits_cut: audits that took longer than --audit-seconds and do not count as passed. --keep writes the motion and
// path of each failure.
#include "bench/assembly_files.h"
#include "bench/command_line.h"
#include "bench/timing.h"
#include "dismantle/audit/audit_path.h"
#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/documents/motion_file.h"
#include "dismantle/documents/path_file.h"
#include "dismantle/engine/classify_pairs.h"
#include "dismantle/loading/load_assembly.h"
#include "dismantle/session/play_motion.h"
#include "tests/support/random_scenes.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace dismantle {
namespace {

namespace fs = std::filesystem;

struct Settings {
  std::size_t steps = 17'000;  // of all assemblies together
  std::uint64_t seed = 1;
  int threads = 1;
  int targets = 50;  // of a drag
  double audit_seconds = 60;
  std::string keep;
  std::vector<std::string> assemblies;
};

constexpr int kDragsPerBatch = 3;
constexpr double kStuckAllowance = 0.9, kStuckProgress = 0.9;

struct Row {
  std::size_t steps = 0, reached = 0, batches = 0, violations = 0;
  std::size_t audits_cut = 0, straight_motions = 0, stuck = 0, front = 0;
  std::vector<double> us;
};

/// Targets of one drag: a steady pull of a random component from its assembled pose in a random direction, trembling.
MotionMove random_drag(std::mt19937_64& random, const Assembly& assembly, int targets) {
  const auto index = static_cast<std::size_t>(random() % assembly.components.size());
  const Component& component = assembly.components[index];
  const Aabb box = assembled_bounds(component);
  const double size = diagonal(box);
  const double shake = std::min(0.3, 0.02 * size);
  Vec3 direction = normalized(scenes::random_vector(random, 1) + Vec3{0, 0, 1e-9});
  if (random() % 2 == 0) {  // along an axis, as most fits are
    Vec3 axis;
    axis[static_cast<int>(random() % 3)] = random() % 2 == 0 ? 1 : -1;
    direction = axis;
  }
  const double length = size * std::uniform_real_distribution<double>(0.05, 1.5)(random);
  MotionMove move{{component.name}, {}};
  for (int k = 1; k <= targets; ++k) {
    const Pose center{box.center() + (length * k / targets) * direction, {}};
    const Pose target = center * scenes::random_pose(random, shake, 0.06) * Pose{-box.center(), {}};
    move.targets.push_back({0.01 * k, target});
  }
  return move;
}

/// The assembly as it is at these poses, as an assembled state.
Assembly frozen(const Assembly& assembly, Span<const Pose> poses) {
  Assembly now = assembly;
  for (std::size_t c = 0; c < poses.size(); ++c)
    now.components[c].assembly_from_mesh = transform_from_pose(poses[c]) * now.components[c].assembly_from_mesh;
  return now;
}

double diagonal_of(const Assembly& assembly) {
  return diagonal(assembled_bounds(assembly));
}

/// True if an audit accepts a straight motion of the component from its pose, with a part of every allowance.
bool straight_is_free(const Assembly& now, const PairStates& states, const std::vector<ComponentPair>& joined,
                      ComponentId moving, Vec3 displacement) {
  Path path;
  for (const Component& c : now.components) path.components.push_back(c.name);
  path.tolerance = kStuckAllowance * states.tolerance;
  for (const ComponentPair& pair : joined)
    path.pairs.push_back({now[pair.a].name, now[pair.b].name, PathPairState::Declared, 0,
                          kStuckAllowance * std::min(pair.allowed_depth, states.tolerance + diagonal_of(now))});
  path.moves.push_back({"straight", {now[moving].name}, {{0, {}}, {1, {displacement, {}}}}});
  const AuditReport report = audit_path(now, path);
  return std::none_of(report.violations.begin(), report.violations.end(), [&](const AuditViolation& v) {
    return v.kind != AuditViolationKind::PathInconsistent && (v.a == moving || v.b == moving);
  });
}

/// Tests whether the component that was moved last is stuck, by short straight motions.
void test_for_stuck(const Assembly& assembly, const PairStates& states, ComponentId moving, CertificateEngine& engine,
                    Row& row) {
  const std::vector<Pose> poses(engine.poses().begin(), engine.poses().end());
  const Assembly now = frozen(assembly, poses);
  const double distance = std::min(0.5, 0.05 * diagonal(assembled_bounds(assembly[moving])));
  for (int k = 0; k < 6; ++k) {
    Vec3 displacement;
    displacement[k / 2] = k % 2 == 0 ? distance : -distance;
    engine.jump(poses);
    engine.grab({&moving, 1});
    if (!straight_is_free(now, states, engine.overlapping_pairs(), moving, displacement)) continue;
    ++row.straight_motions;
    const Pose& pose = poses[moving.value];
    const StepResult result = engine.step({pose.position + displacement, pose.rotation}, ResponseKind::Slide);
    const double made = dot(result.pose.position - pose.position, displacement) / (distance * distance);
    if (made < kStuckProgress) ++row.stuck;
  }
}

class Soak {
 public:
  Soak(const Settings& settings, std::string name, const Assembly& assembly, const PairStates& states)
      : settings_(settings), name_(std::move(name)), assembly_(assembly), states_(states) {}

  Row run(std::size_t steps) {
    for (std::uint64_t batch = 0; row_.steps < steps; ++batch) run_batch(settings_.seed * 1'000'003 + batch);
    return std::move(row_);
  }

 private:
  void run_batch(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    Motion motion;
    motion.response = ResponseKind::Slide;
    for (int k = 0; k < kDragsPerBatch; ++k) motion.moves.push_back(random_drag(random, assembly_, settings_.targets));

    CertificateOptions options;
    if (settings_.threads > 1) options.executor = Executor(ExecutorKind::Threads, settings_.threads);
    CertificateEngine engine(assembly_, states_, options);
    const Result<PlayedMotion> played = play_motion(assembly_, states_, motion, engine);
    for (const PlayedStep& step : played->steps) {
      row_.us.push_back(1e3 * step.result.cost.ms);
      row_.reached += step.result.reached ? 1 : 0;
      row_.front = std::max(row_.front, step.result.cost.pairs);
    }
    row_.steps += played->steps.size();
    ++row_.batches;

    AuditOptions audit_options;
    const bench::Stopwatch watch;
    audit_options.progress = [&](std::string_view, double) { return watch.seconds() < settings_.audit_seconds; };
    const AuditReport report = audit_path(assembly_, played->path, audit_options);
    row_.audits_cut += report.complete ? 0 : 1;
    row_.violations += report.violations.size();
    const std::size_t stuck_before = row_.stuck;
    test_for_stuck(assembly_, states_, *assembly_.find(motion.moves.back().components.front()), engine, row_);
    if (!report.violations.empty() || row_.stuck > stuck_before) report_failure(seed, motion, played->path, report);
  }

  void report_failure(std::uint64_t seed, const Motion& motion, const Path& path, const AuditReport& report) const {
    std::fprintf(stderr, "  %s, seed %llu: %zu violations%s%s\n", name_.c_str(), static_cast<unsigned long long>(seed),
                 report.violations.size(), report.violations.empty() ? ", stuck" : "; ",
                 report.violations.empty() ? "" : report.violations.front().message.c_str());
    if (settings_.keep.empty()) return;
    fs::create_directories(settings_.keep);
    const std::string stem = settings_.keep + "/" + name_ + "." + std::to_string(seed);
    if (!write_motion(stem + ".motion.json", motion) || !write_path(stem + ".path.json", path))
      std::fprintf(stderr, "  %s could not be written\n", stem.c_str());
  }

  const Settings& settings_;
  std::string name_;
  const Assembly& assembly_;
  const PairStates& states_;
  Row row_;
};

void print_row(const std::string& name, const Assembly& assembly, const PairStates& states, const Row& row,
               double seconds) {
  std::printf("%s\t%zu\t%zu\t%.4g\t%zu\t%zu\t%.1f\t%.1f\t%.1f\t%zu\t%zu\t%zu\t%zu\t%zu\t%zu\t%.0f\n", name.c_str(),
              assembly.components.size(), triangle_count(assembly), states.tolerance, row.steps, row.reached,
              bench::quantile(row.us, 0.5), bench::quantile(row.us, 0.99), bench::quantile(row.us, 1), row.front,
              row.batches, row.violations, row.audits_cut, row.straight_motions, row.stuck, seconds);
  std::fflush(stdout);
}

/// An assembly file, and its name in the table.
struct Input {
  std::string name, file;
};

std::vector<Input> find_inputs(const Settings& settings) {
  std::vector<Input> inputs;
  for (const std::string& file : settings.assemblies) inputs.push_back({bench::assembly_name(file), file});
  if (!inputs.empty()) return inputs;
  for (const char* name : {"microscope", "tooling", "lathe", "robot"})
    inputs.push_back({name, std::string(DISMANTLE_SOURCE_DIR "/samples/") + name + ".step"});
  const fs::path data(DISMANTLE_SOURCE_DIR "/../shared/data/assemblies");
  if (!fs::exists(data)) return inputs;
  std::vector<Input> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(data))
    if (fs::exists(entry.path() / "parts"))
      found.push_back({bench::assembly_name(entry.path() / "parts"), (entry.path() / "parts").string()});
  std::sort(found.begin(), found.end(), [](const Input& a, const Input& b) { return a.name < b.name; });
  inputs.insert(inputs.end(), found.begin(), found.end());
  return inputs;
}

/// Prints a row. @return false where a path broke the guarantee or a component was stuck
bool run(const Settings& settings, const Input& input, std::size_t steps) {
  const bench::Stopwatch watch;
  const Result<Assembly> assembly = load_assembly(input.file);
  const Result<PairStates> states = assembly ? classify_pairs(*assembly, {}) : Result<PairStates>(assembly.error());
  if (!states) {
    std::fprintf(stderr, "soak_motion: %s\n", states.error().message.c_str());
    return false;
  }
  const Row row = Soak(settings, input.name, *assembly, *states).run(steps);
  print_row(input.name, *assembly, *states, row, watch.seconds());
  return row.violations == 0 && row.stuck == 0;
}

bool parse(int argc, char** argv, Settings& settings) {
  bench::CommandLine line(
      "soak_motion [--steps N] [--seed N] [--threads N] [--targets N] [--audit-seconds S]\n"
      "                   [--keep FOLDER] [ASSEMBLY...]");
  line.option("--steps", settings.steps, 1);
  line.option("--seed", settings.seed, 0);
  line.option("--threads", settings.threads, 1);
  line.option("--targets", settings.targets, 1);
  line.option("--audit-seconds", settings.audit_seconds);
  line.option("--keep", settings.keep);
  line.words(settings.assemblies);
  return line.parse(argc, argv);
}

}  // namespace
}  // namespace dismantle

int main(int argc, char** argv) {
  using namespace dismantle;
  Settings settings;
  if (!parse(argc, argv, settings)) return bench::kExitUsage;
  std::printf(
      "assembly\tcomponents\ttriangles\ttolerance_mm\tsteps\treached\tmedian_us\tp99_us\tmax_us\tfront\tbatches\t"
      "violations\taudits_cut\tstraight_motions\tstuck\twall_s\n");
  const std::vector<Input> inputs = find_inputs(settings);
  bool good = true;
  for (const Input& input : inputs) good = run(settings, input, settings.steps / inputs.size()) && good;
  return good ? 0 : bench::kExitFailed;
}
