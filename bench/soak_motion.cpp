// SPDX-License-Identifier: Apache-2.0
// Random drags over assemblies with the method `certificates` and response `slide`, every path audited.
//   soak_motion [--steps N] [--seed N] [--jobs N] [--threads N] [--targets N] [--audit-seconds S] [--seconds S]
//               [--record FILE] [--keep FOLDER] [ASSEMBLY...]
// Without names: the samples and every assembly of the data folder beside the repository. Steps are shared out so that
// an assembly with four times as many triangles gets half as many. What a batch does: bench/soak/batch.h. --jobs
// batches run at the same time, each with --threads. --record: the batches that FILE has are not run again, and those
// that are run are added to it. --seconds: starts no batch after that time, and says what is left. --keep writes the
// motion and path of each failure. One row an assembly, tab-separated, of all its batches; times of a step are exact to
// 5%, the longest is exact: processor time with one thread a batch, so that other programs do not count; else wall
// time. Exit code 1 where an audit found a violation, a component was stuck, or batches are left. audits_cut: audits
// that took longer than --audit-seconds and do not count as passed.
#include "bench/assembly_files.h"
#include "bench/command_line.h"
#include "bench/soak/record.h"
#include "bench/timing.h"
#include "dismantle/documents/motion_file.h"
#include "dismantle/documents/path_file.h"
#include "dismantle/engine/classify_pairs.h"
#include "dismantle/loading/load_assembly.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>

namespace dismantle::soak {
namespace {

namespace fs = std::filesystem;

/// The batches of all assemblies are run in so many rounds, so that what is recorded of a soak that was ended is of all
/// of them.
constexpr int kRounds = 20;

struct Settings {
  std::size_t steps = 17'000;  // of all assemblies together
  std::uint64_t seed = 1;
  int jobs = 1;
  double seconds = 1e9;
  BatchOptions batch;
  std::string record, keep;
  std::vector<std::string> assemblies;
};

/// An assembly file, and its name in the table.
struct Input {
  std::string name, file;
};

/// An assembly with what every batch needs.
struct Loaded {
  Input input;
  Assembly assembly;
  double weight = 0;  // of its share of the steps
};

/// Data shared by all batches of an assembly.
struct Prepared {
  PairStates states;
  std::shared_ptr<const AssemblySurfaces> surfaces;
  PathAuditor auditor;
};

/// Prints the row of an assembly. @return true if it has batches and nothing is wrong with any of them
bool print_row(const Input& input, const Assembly& assembly, const Record& record) {
  const BatchResult sum = record.of(input.name);
  std::printf("%s\t%zu\t%zu\t%.4g\t%zu\t%zu\t%.1f\t%.1f\t%.1f\t%zu\t%zu\t%zu\t%zu\t%zu\t%zu\t%.0f\t%.0f\n",
              input.name.c_str(), assembly.components.size(), triangle_count(assembly), default_tolerance(assembly),
              sum.steps, sum.reached, sum.times.quantile(0.5), sum.times.quantile(0.99), sum.longest_us, sum.front,
              sum.batches, sum.violations, sum.audits_cut, sum.straight_motions, sum.stuck, sum.engine_seconds,
              sum.audit_seconds);
  std::fflush(stdout);
  return sum.batches > 0 && sum.good();
}

std::vector<Input> find_inputs(const Settings& settings) {
  std::vector<Input> inputs;
  for (const std::string& file : settings.assemblies) inputs.push_back({bench::assembly_name(file), file});
  if (!inputs.empty()) return inputs;
  for (const char* name : {"microscope", "tooling", "lathe", "robot"})
    inputs.push_back({name, std::string(DISMANTLE_SOURCE_DIR "/samples/") + name + ".step"});
  std::vector<Input> found;
  const fs::path data(DISMANTLE_SOURCE_DIR "/../shared/data");
  const auto each = [](const fs::path& folder, const auto& visit) {
    if (fs::exists(folder))
      for (const fs::directory_entry& entry : fs::directory_iterator(folder)) visit(entry.path());
  };
  const auto add = [&found](const fs::path& file) { found.push_back({bench::assembly_name(file), file.string()}); };
  each(data / "assemblies", [&](const fs::path& folder) {
    if (fs::exists(folder / "parts")) add(folder / "parts");
  });
  each(data / "wild", [&](const fs::path& file) {
    bool has_meshes = false;
    if (fs::is_directory(file)) each(file, [&](const fs::path& part) { has_meshes |= part.extension() == ".stl"; });
    if (file.extension() == ".step" || has_meshes) add(file);
  });
  std::sort(found.begin(), found.end(), [](const Input& a, const Input& b) { return a.name < b.name; });
  inputs.insert(inputs.end(), found.begin(), found.end());
  return inputs;
}

bool parse(int argc, char** argv, Settings& settings) {
  bench::CommandLine line(
      "soak_motion [--steps N] [--seed N] [--jobs N] [--threads N] [--targets N] [--audit-seconds S] [--seconds S]\n"
      "                   [--record FILE] [--keep FOLDER] [ASSEMBLY...]");
  line.option("--steps", settings.steps, 1);
  line.option("--seed", settings.seed, 0);
  line.option("--jobs", settings.jobs, 1);
  line.option("--threads", settings.batch.threads, 1);
  line.option("--targets", settings.batch.targets, 1);
  line.option("--audit-seconds", settings.batch.audit_seconds);
  line.option("--seconds", settings.seconds);
  line.option("--record", settings.record);
  line.option("--keep", settings.keep);
  line.words(settings.assemblies);
  return line.parse(argc, argv);
}

/// Reads the assemblies. @return false where one cannot be read
bool load(const Settings& settings, std::vector<Loaded>& loaded) {
  for (const Input& input : find_inputs(settings)) {
    Result<Assembly> assembly = load_assembly(input.file);
    if (!assembly) {
      std::fprintf(stderr, "soak_motion: %s\n", assembly.error().message.c_str());
      return false;
    }
    const double weight = 1 / std::sqrt(static_cast<double>(std::max<std::size_t>(triangle_count(*assembly), 1)));
    loaded.push_back({input, std::move(*assembly), weight});
  }
  return true;
}

/// Number of batches of an assembly in the first rounds.
std::uint64_t count_batches(const Settings& settings, const std::vector<Loaded>& loaded, const Loaded& one,
                            int rounds) {
  double weights = 0;
  for (const Loaded& each : loaded) weights += each.weight;
  const double steps = static_cast<double>(settings.steps) * one.weight / weights * rounds / kRounds;
  return static_cast<std::uint64_t>(std::ceil(steps / (kDragsPerBatch * settings.batch.targets)));
}

/// The batches that are left, which several threads take one after another.
class Soak {
 public:
  Soak(const Settings& settings, const std::vector<Loaded>& loaded, Record& record)
      : settings_(settings), loaded_(loaded), record_(record), prepared_(loaded.size()), once_(loaded.size()) {
    for (int round = 1; round <= kRounds; ++round)
      for (std::size_t which = 0; which < loaded.size(); ++which) {
        const Loaded& one = loaded[which];
        const std::uint64_t first = count_batches(settings, loaded, one, round - 1);
        for (std::uint64_t batch = first; batch < count_batches(settings, loaded, one, round); ++batch)
          if (!record.has(one.input.name, batch)) left_.push_back({which, batch});
      }
  }

  /// Runs the batches until the time is up. @return the number of those that are left; none where one failed
  std::optional<std::size_t> run() {
    const bench::Stopwatch watch;
    const Executor executor = settings_.jobs > 1 ? Executor(ExecutorKind::Threads, settings_.jobs) : Executor();
    executor.for_each_heavy(static_cast<std::size_t>(settings_.jobs), [&](std::size_t) {
      while (!failed_ && watch.seconds() < settings_.seconds) {
        const std::size_t i = next_++;
        if (i >= left_.size()) return;
        if (!run_batch(left_[i])) failed_ = true;
      }
    });
    if (failed_) return std::nullopt;
    return left_.size() - std::min<std::size_t>(next_, left_.size());
  }

 private:
  struct Item {
    std::size_t which;  // assembly
    std::uint64_t batch;
  };

  const Prepared* prepare(std::size_t which) {
    std::call_once(once_[which], [&] {
      const Assembly& assembly = loaded_[which].assembly;
      Result<PairStates> states = classify_pairs(assembly, {});
      if (states)
        prepared_[which].emplace(
            Prepared{*states, CertificateEngine(assembly, *states).surfaces(), PathAuditor(assembly)});
      else
        std::fprintf(stderr, "soak_motion: %s\n", states.error().message.c_str());
    });
    return prepared_[which] ? &*prepared_[which] : nullptr;
  }

  bool run_batch(Item item) {
    const Loaded& one = loaded_[item.which];
    const Prepared* prepared = prepare(item.which);
    if (prepared == nullptr) return false;
    const Batch batch = soak::run_batch(one.assembly, prepared->states, prepared->surfaces, prepared->auditor,
                                        settings_.seed * 1'000'003 + item.batch, settings_.batch);
    if (!batch.result.good()) report_failure(one.input.name, item.batch, batch);
    const Result<Done> added = record_.add(one.input.name, item.batch, batch.result);
    if (!added) std::fprintf(stderr, "soak_motion: %s\n", added.error().message.c_str());
    return static_cast<bool>(added);
  }

  void report_failure(const std::string& name, std::uint64_t number, const Batch& batch) const {
    std::fprintf(stderr, "  %s, batch %llu: %zu violations, %zu stuck; %s\n", name.c_str(),
                 static_cast<unsigned long long>(number), batch.result.violations, batch.result.stuck,
                 batch.result.message.c_str());
    if (settings_.keep.empty()) return;
    fs::create_directories(settings_.keep);
    const std::string stem = settings_.keep + "/" + name + "." + std::to_string(number);
    if (!write_motion(stem + ".motion.json", batch.motion) || !write_path(stem + ".path.json", batch.path))
      std::fprintf(stderr, "  %s could not be written\n", stem.c_str());
  }

  const Settings& settings_;
  const std::vector<Loaded>& loaded_;
  Record& record_;
  std::vector<std::optional<Prepared>> prepared_;
  std::vector<std::once_flag> once_;
  std::vector<Item> left_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> failed_ = false;
};

bool run(const Settings& settings, Record& record, const std::vector<Loaded>& loaded) {
  const std::optional<std::size_t> left = Soak(settings, loaded, record).run();
  if (!left) return false;
  bool good = true;
  for (const Loaded& one : loaded) good = print_row(one.input, one.assembly, record) && good;
  if (*left > 0) std::fprintf(stderr, "soak_motion: %zu batches are left\n", *left);
  return good && *left == 0;
}

}  // namespace
}  // namespace dismantle::soak

int main(int argc, char** argv) {
  using namespace dismantle;
  soak::Settings settings;
  if (!soak::parse(argc, argv, settings)) return bench::kExitUsage;
  Result<soak::Record> record = soak::Record::open(settings.record, settings.seed, settings.batch.targets);
  if (!record) {
    std::fprintf(stderr, "soak_motion: %s\n", record.error().message.c_str());
    return bench::kExitUsage;
  }
  std::vector<soak::Loaded> loaded;
  if (!soak::load(settings, loaded)) return bench::kExitUnreadable;
  std::printf(
      "assembly\tcomponents\ttriangles\ttolerance_mm\tsteps\treached\tmedian_us\tp99_us\tmax_us\tfront\tbatches\t"
      "violations\taudits_cut\tstraight_motions\tstuck\tengine_s\taudit_s\n");
  return soak::run(settings, *record, loaded) ? 0 : bench::kExitFailed;
}
