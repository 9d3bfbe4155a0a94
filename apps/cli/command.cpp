// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/command.h"

#include "apps/cli/option_checks.h"
#include "apps/cli/plan_text.h"
#include "dismantle/files/number_text.h"
#include "dismantle/files/user_folders.h"
#include "dismantle/formats/import/file_formats.h"
#include "dismantle/loading/load_assembly.h"
#include "dismantle/simplify/simplify_assembly.h"
#include "dismantle/surface/find_clashes.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

namespace dismantle::cli {

namespace {

volatile std::sig_atomic_t g_interrupted = 0;
bool g_errors_as_json = false;  // set once, by main()

void interrupt(int) {
  if (g_interrupted) std::_Exit(static_cast<int>(ExitCode::Failed));  // a second Ctrl+C does not wait
  g_interrupted = 1;
}

/// Notes that the unit is probably wrong, if the assembly is larger or smaller than assemblies are.
void note_size(const Assembly& assembly) {
  constexpr double kMin = 1, kMax = 20000;  // [mm]
  const Vec3 size = assembled_bounds(assembly).size();
  const double longest = std::max({size.x, size.y, size.z});
  if (longest <= 0 || (longest >= kMin && longest <= kMax)) return;
  const std::string text = longest < kMin ? number_text(longest, 3) + " mm" : number_text(longest / 1000, 3) + " m";
  std::fprintf(
      stderr,
      "dismantle: note: the assembly is %s long (read in %s); if that is wrong, give the unit of the file with "
      "--units\n",
      text.c_str(), assembly.source_units.c_str());
}

}  // namespace

void add_common_options(CLI::App& command, CommonOptions& o) {
  static const std::map<std::string, ClassifyRule> kRules{{"auto", ClassifyRule::Auto}, {"paper", ClassifyRule::Paper}};
  static const std::map<std::string, DeviceChoice> kDevices{
      {"cpu", DeviceChoice::Cpu}, {"cuda", DeviceChoice::Cuda}, {"auto", DeviceChoice::Auto}};
  const std::string group = "Common options";
  command.add_option("--units", o.import.units, "Unit of the input's coordinates")
      ->type_name("mm|cm|m|um|in|ft")
      ->check(one_of({"mm", "cm", "m", "um", "in", "ft"}))
      ->group(group);
  command.add_option("--deflection", o.import.deflection, "CAD files: largest distance of a triangle from its surface")
      ->type_name("MM")
      ->check(above_zero())
      ->group(group);
  command
      .add_option("--angular-deflection", o.import.angular_deflection,
                  "CAD files: largest angle between neighbouring facets")
      ->type_name("RAD")
      ->check(above_zero())
      ->group(group);
  static const std::map<std::string, Solids> kSolids{{"split", Solids::Split}, {"join", Solids::Join}};
  command
      .add_option("--solids", o.import.solids,
                  "A product with several solids, or a URDF link with several visuals, gives a component of each "
                  "(split) or one of all (join)")
      ->transform(choice(kSolids))
      ->type_name("split|join")
      ->group(group);
  command
      .add_flag("--drop-duplicates", o.import.drop_duplicates,
                "Leave out components that are identical with another one and in the same place")
      ->group(group);
  command
      .add_option("--references", o.import.reference_folders,
                  "Let the files that the input refers to be in this folder, too, and not only in its own")
      ->type_name("FOLDER")
      ->check(CLI::ExistingDirectory)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group(group);
  command
      .add_option_function<double>(
          "--import-memory",
          [&o](double mebibytes) { o.import.limits.memory_bytes = static_cast<std::uint64_t>(mebibytes * (1 << 20)); },
          "Memory that reading the input may take (default: by its size)")
      ->type_name("MIB")
      ->check(between(1, 1 << 24))
      ->group(group);
  command
      .add_option("--import-time", o.import.limits.cpu_seconds,
                  "Processor time that reading the input may take (default: by its size)")
      ->type_name("S")
      ->check(above_zero())
      ->group(group);
  command
      .add_option("--tolerance", o.tolerance,
                  "Penetration that still counts as contact (default: from size and deflection)")
      ->type_name("MM")
      ->check(above_zero())
      ->group(group);
  command
      .add_option("--pairs", o.pairs,
                  "What pairs that touch or overlap may do: auto (get no deeper) or paper (anything until they have "
                  "been apart)")
      ->transform(choice(kRules))
      ->type_name("auto|paper")
      ->group(group);
  // Of version 0.1, which took pairs that overlap by more for embedded: all pairs are treated alike now.
  command
      .add_option_function<double>(
          "--fit",
          [](double) {
            std::fprintf(stderr, "dismantle: note: --fit has no effect any more; all overlaps are kept\n");
          })
      ->group("");
  o.import.cache_folder = user_cache_folder().value_or(std::filesystem::path());
  command
      .add_flag_callback(
          "--no-cache", [&o] { o.import.cache_folder.clear(); },
          "CAD files: neither use nor keep the triangles of files that were read before")
      ->group(group);
  command.add_option("--simplify", o.simplify, "Simplify to about N triangles after loading")
      ->type_name("N")
      ->check(above_zero())
      ->group(group);
  command.add_option("--device", o.device, "Device: cpu, cuda, or auto (cuda if available and faster)")
      ->transform(choice(kDevices))
      ->type_name("cpu|cuda|auto")
      ->group(group);
  command.add_option("--threads", o.threads, "Threads (default: all)")
      ->type_name("N")
      ->check(between(1, 1024))
      ->group(group);
  command.add_flag("--json", o.json, "Print the result as JSON")->group(group);
  command.add_flag("--quiet", o.quiet, "Do not print progress")->group(group);
}

void add_allow_option(CLI::App& command, CommonOptions& o) {
  command
      .add_option_function<std::vector<std::string>>(
          "--allow",
          [&o](const std::vector<std::string>& words) {
            for (std::size_t i = 0; i + 2 < words.size(); i += 3) {
              char* end = nullptr;
              const double depth = std::strtod(words[i + 2].c_str(), &end);
              if (*end != '\0' || !(depth > 0) || !std::isfinite(depth))
                throw CLI::ValidationError("--allow", "the depth of '" + words[i] + "' and '" + words[i + 1] +
                                                          "' is '" + words[i + 2] + "', and not a number above 0");
              o.allowed.push_back({words[i], words[i + 1], depth});
            }
          },
          "Let two components that touch or overlap get MM deep in each other until they have been apart: one of them "
          "is flexible, or drawn wrong. May be repeated")
      ->type_name("A B MM")
      ->type_size(3)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

double default_overlap_limit(const Assembly& assembly) {
  constexpr double kShare = 0.01, kMost = 0.5;
  return std::min(kMost, kShare * diagonal(assembled_bounds(assembly)));
}

void add_assembly_argument(CLI::App& command, CommonOptions& o) {
  command.add_option("ASSEMBLY", o.assembly_file, format_names(", ") + ", or a folder of meshes")->required();
}

bool is_path_file(const std::string& file) {
  constexpr std::string_view kSuffix = ".path.json";
  return file.size() > kSuffix.size() && file.compare(file.size() - kSuffix.size(), kSuffix.size(), kSuffix) == 0;
}

Result<std::filesystem::path> assembly_beside(const std::string& path_file, const Path& path) {
  namespace fs = std::filesystem;
  fs::path assembly = fs::absolute(path_file).parent_path() / fs::path(path.assembly_file).filename();
  if (!fs::exists(assembly))
    return Error{ErrorKind::Unreadable, path_file + " cannot be followed (its assembly '" + path.assembly_file +
                                            "' is not in its folder); put both into one folder"};
  return assembly;
}

void note_other_version(const Path& path, const Assembly& assembly) {
  if (!path.assembly_sha256.empty() && path.assembly_sha256 != assembly.source_sha256)
    std::fprintf(stderr, "dismantle: note: the path was made for another version of the assembly (SHA-256 differs)\n");
}

ProgressCallback progress_printer(const CommonOptions& options) {
  std::signal(SIGINT, interrupt);
  const bool show = !options.quiet && isatty(STDERR_FILENO);
  return [show](std::string_view stage, double fraction) {
    if (show) {
      const int percent = fraction < 0 ? 0 : static_cast<int>(100 * fraction);
      std::fprintf(stderr, "\r\033[K%.*s %d%%%s", static_cast<int>(stage.size()), stage.data(), percent,
                   fraction >= 1 ? "\r\033[K" : "");
      std::fflush(stderr);
    }
    return g_interrupted == 0;
  };
}

Executor make_executor(const CommonOptions& options) {
  return Executor(options.threads == 1 ? ExecutorKind::Serial : ExecutorKind::Threads, options.threads);
}

void note_cpu(const CommonOptions& options, const std::string& why) {
  if (options.device == DeviceChoice::Cuda)
    std::fprintf(stderr, "dismantle: note: computing on the CPU (%s)\n", why.c_str());
}

Result<Assembly> load(const CommonOptions& options) {
  if (!options.uses_device) note_cpu(options, "only move and view use a GPU");
  ImportOptions import = options.import;
  import.progress = progress_printer(options);
  Result<Assembly> assembly = load_assembly(options.assembly_file, import);
  if (assembly) note_size(*assembly);
  if (!assembly || options.simplify == 0) return assembly;

  SimplifyOptions simplify;
  simplify.executor = make_executor(options);
  simplify.progress = import.progress;
  Result<SimplifiedAssembly> simplified = simplify_assembly(*assembly, options.simplify, simplify);
  if (!simplified) return simplified.error();
  return std::move(simplified->assembly);
}

Result<PairStates> classify(const Assembly& assembly, const CommonOptions& options, double clearance) {
  ClassifyOptions classify;
  classify.tolerance = options.tolerance;
  classify.clearance = clearance;
  classify.rule = options.pairs;
  for (const DeclaredAllowance& own : options.allowed)
    for (const std::string& name : {own.a, own.b})
      if (const Result<ComponentId> id = find_component(assembly, name); !id) return id.error();
  classify.declared = options.allowed;
  classify.executor = make_executor(options);
  classify.progress = progress_printer(options);
  return classify_pairs(assembly, classify);
}

Result<Clashes> clashes_of(const Assembly& assembly, const CommonOptions& options, double clearance) {
  ClashOptions clash;
  clash.tolerance = options.tolerance;
  clash.clearance = clearance;
  clash.executor = make_executor(options);
  clash.progress = progress_printer(options);
  return find_clashes(assembly, clash);
}

void report_errors_as_json() {
  g_errors_as_json = true;
}

ExitCode report(const Error& error) {
  std::fprintf(stderr, "dismantle: %s\n", error.message.c_str());
  const auto [code, kind] = error.kind == ErrorKind::Usage        ? std::pair(ExitCode::Usage, "usage")
                            : error.kind == ErrorKind::Unreadable ? std::pair(ExitCode::Unreadable, "unreadable")
                                                                  : std::pair(ExitCode::Failed, "failed");
  if (g_errors_as_json) {
    const nlohmann::ordered_json object{{"format", "dismantle-error"},
                                        {"version", 1},
                                        {"kind", kind},
                                        {"exit_code", static_cast<int>(code)},
                                        {"message", error.message}};
    std::printf("%s\n", object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
  }
  return code;
}

}  // namespace dismantle::cli
