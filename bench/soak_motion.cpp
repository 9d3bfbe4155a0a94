// SPDX-License-Identifier: Apache-2.0
// Random drags with the method `certificates` and response `slide` over assemblies, every path audited.
//   soak_motion [--steps N] [--seed N] [--threads N] [--targets N] [--audit-seconds S] [--keep FOLDER] [ASSEMBLY...]
// Without names: the samples and every assembly of the data folder beside the repository. A batch starts assembled and
// drags a few random components one after another, in random directions, by a trembling hand that takes no notice of
// what is in the way. Then the last component is tried for being stuck: where the audit lets a short straight motion
// through with nine tenths of every allowance, the engine must make nine tenths of it.
// One row an assembly, tab-separated; exit code 1 where an audit found something or a component was stuck. `cut`
// counts the audits that took longer than allowed and are not counted as clean. --keep writes what failed.
#include "dismantle/audit/audit_path.h"
#include "dismantle/collision/certificate_engine.h"
#include "dismantle/collision/classify_pairs.h"
#include "dismantle/io/load_assembly.h"
#include "dismantle/io/motion_file.h"
#include "dismantle/io/path_file.h"
#include "dismantle/session/play_motion.h"
#include "tests/support/random_scenes.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace dismantle {
namespace {

namespace fs = std::filesystem;

struct Settings {
  std::size_t steps = 17'000;  // over all assemblies
  std::uint64_t seed = 1;
  int threads = 1;
  int targets = 50;  // a drag
  double audit_seconds = 60;
  std::string keep;
  std::vector<std::string> assemblies;
};

constexpr int kDragsPerBatch = 3;
constexpr double kStuckAllowance = 0.9, kStuckProgress = 0.9;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Row {
  std::size_t steps = 0, reached = 0, batches = 0, violations = 0, cut = 0, straight = 0, stuck = 0, front = 0;
  std::vector<double> us;
};

/// The hand's motion of one drag: a steady pull in a random direction from the component's assembled place, trembling.
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
  const double way = size * std::uniform_real_distribution<double>(0.05, 1.5)(random);
  MotionMove move{{component.name}, {}};
  for (int k = 1; k <= targets; ++k) {
    const Pose place{box.center() + (way * k / targets) * direction, {}};
    const Pose target = place * scenes::random_pose(random, shake, 0.06) * Pose{-box.center(), {}};
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

/// Whether an audit lets the component go straight from where it is, with a part of every allowance.
bool straight_is_free(const Assembly& now, const PairStates& states, const std::vector<ComponentPair>& embedded,
                      ComponentId moving, Vec3 way) {
  Path path;
  for (const Component& c : now.components) path.components.push_back(c.name);
  path.tolerance = kStuckAllowance * states.tolerance;
  for (const ComponentPair& pair : states.pairs) {
    if (pair.state != PairState::Fit) continue;
    path.pairs.push_back({now[pair.a].name, now[pair.b].name, pair.state, kStuckAllowance * pair.allowed_penetration});
  }
  for (const ComponentPair& pair : embedded)
    path.pairs.push_back({now[pair.a].name, now[pair.b].name, PairState::Embedded, pair.allowed_penetration});
  path.moves.push_back({"straight", {now[moving].name}, {{0, {}}, {1, {way, {}}}}});
  const AuditReport report = audit_path(now, path);
  return std::none_of(report.violations.begin(), report.violations.end(),
                      [&](const AuditViolation& v) { return v.a == moving || v.b == moving; });
}

/// Tries short straight motions of what was moved last.
void try_for_stuck(const Assembly& assembly, const PairStates& states, ComponentId moving, CertificateEngine& engine,
                   Row& row) {
  const std::vector<Pose> poses(engine.poses().begin(), engine.poses().end());
  const Assembly now = frozen(assembly, poses);
  const double distance = std::min(0.5, 0.05 * diagonal(assembled_bounds(assembly[moving])));
  for (int k = 0; k < 6; ++k) {
    Vec3 way;
    way[k / 2] = k % 2 == 0 ? distance : -distance;
    engine.jump(poses);
    engine.hold({&moving, 1});
    if (!straight_is_free(now, states, engine.embedded_pairs(), moving, way)) continue;
    ++row.straight;
    const Pose& pose = poses[moving.value];
    const StepResult result = engine.step({pose.position + way, pose.rotation}, ResponseKind::Slide);
    const double made = dot(result.pose.position - pose.position, way) / (distance * distance);
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

    CertificateOptions how;
    if (settings_.threads > 1) how.executor = Executor(ExecutorKind::Threads, settings_.threads);
    CertificateEngine engine(assembly_, states_, how);
    const Result<PlayedMotion> played = play_motion(assembly_, states_, motion, engine);
    for (const PlayedStep& step : played->steps) {
      row_.us.push_back(1e3 * step.result.timings.overall);
      row_.reached += step.result.reached ? 1 : 0;
      row_.front = std::max(row_.front, step.result.sizes.front);
    }
    row_.steps += played->steps.size();
    ++row_.batches;

    AuditOptions options;
    const auto start = std::chrono::steady_clock::now();
    options.progress = [&](std::string_view, double) { return seconds_since(start) < settings_.audit_seconds; };
    const AuditReport report = audit_path(assembly_, played->path, options);
    row_.cut += report.complete ? 0 : 1;
    row_.violations += report.violations.size();
    const std::size_t stuck_before = row_.stuck;
    try_for_stuck(assembly_, states_, *assembly_.find(motion.moves.back().components.front()), engine, row_);
    if (!report.violations.empty() || row_.stuck > stuck_before) complain(seed, motion, played->path, report);
  }

  void complain(std::uint64_t seed, const Motion& motion, const Path& path, const AuditReport& report) const {
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

void print_row(const std::string& name, const Assembly& assembly, const PairStates& states, Row row, double seconds) {
  std::sort(row.us.begin(), row.us.end());
  const auto at = [&](std::size_t percent) {
    return row.us[std::min(row.us.size() - 1, row.us.size() * percent / 100)];
  };
  std::printf("%s\t%zu\t%zu\t%.4g\t%zu\t%zu\t%.1f\t%.1f\t%.1f\t%zu\t%zu\t%zu\t%zu\t%zu\t%zu\t%.0f\n", name.c_str(),
              assembly.components.size(), triangle_count(assembly), states.tolerance, row.steps, row.reached, at(50),
              at(99), at(100), row.front, row.batches, row.violations, row.cut, row.straight, row.stuck, seconds);
  std::fflush(stdout);
}

/// The name to print, and what to read.
struct Input {
  std::string name, file;
};

std::vector<Input> find_inputs(const Settings& settings) {
  std::vector<Input> inputs;
  for (const std::string& file : settings.assemblies) {
    const fs::path path(file);
    inputs.push_back(
        {path.filename() == "parts" ? path.parent_path().filename().string() : path.stem().string(), file});
  }
  if (!inputs.empty()) return inputs;
  for (const char* name : {"microscope", "tooling", "lathe", "robot"})
    inputs.push_back({name, std::string(DISMANTLE_SOURCE_DIR "/samples/") + name + ".step"});
  const fs::path data(DISMANTLE_SOURCE_DIR "/../shared/data/assemblies");
  if (!fs::exists(data)) return inputs;
  std::vector<Input> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(data))
    if (fs::exists(entry.path() / "parts"))
      found.push_back({entry.path().filename().string(), (entry.path() / "parts").string()});
  std::sort(found.begin(), found.end(), [](const Input& a, const Input& b) { return a.name < b.name; });
  inputs.insert(inputs.end(), found.begin(), found.end());
  return inputs;
}

/// False where something is wrong.
bool run(const Settings& settings, const Input& input, std::size_t steps) {
  const auto start = std::chrono::steady_clock::now();
  const Result<Assembly> assembly = load_assembly(input.file);
  const Result<PairStates> states = assembly ? classify_pairs(*assembly, {}) : Result<PairStates>(assembly.error());
  if (!states) {
    std::fprintf(stderr, "soak_motion: %s\n", states.error().message.c_str());
    return false;
  }
  const Row row = Soak(settings, input.name, *assembly, *states).run(steps);
  print_row(input.name, *assembly, *states, row, seconds_since(start));
  return row.violations == 0 && row.stuck == 0;
}

bool parse(int argc, char** argv, Settings& settings) {
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option.rfind("--", 0) != 0) {
      settings.assemblies.push_back(option);
      continue;
    }
    if (++i == argc) return false;
    if (option == "--steps") {
      settings.steps = std::strtoull(argv[i], nullptr, 10);
    } else if (option == "--seed") {
      settings.seed = std::strtoull(argv[i], nullptr, 10);
    } else if (option == "--threads") {
      settings.threads = std::max(1, std::atoi(argv[i]));
    } else if (option == "--targets") {
      settings.targets = std::max(1, std::atoi(argv[i]));
    } else if (option == "--audit-seconds") {
      settings.audit_seconds = std::atof(argv[i]);
    } else if (option == "--keep") {
      settings.keep = argv[i];
    } else {
      return false;
    }
  }
  return true;
}

}  // namespace
}  // namespace dismantle

int main(int argc, char** argv) {
  using namespace dismantle;
  Settings settings;
  if (!parse(argc, argv, settings)) {
    std::fprintf(stderr,
                 "usage: soak_motion [--steps N] [--seed N] [--threads N] [--targets N] [--audit-seconds S]\n"
                 "                   [--keep FOLDER] [ASSEMBLY...]\n");
    return 2;
  }
  std::printf(
      "assembly\tcomponents\ttriangles\ttolerance\tsteps\treached\tmedian_us\tp99_us\tmax_"
      "us\tfront\tbatches\tviolations\t"
      "cut\tstraight\tstuck\tseconds\n");
  const std::vector<Input> inputs = find_inputs(settings);
  bool good = true;
  for (const Input& input : inputs) good = run(settings, input, settings.steps / inputs.size()) && good;
  return good ? 0 : 1;
}
