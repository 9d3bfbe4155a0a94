// SPDX-License-Identifier: Apache-2.0
#include "apps/batch/launched_rank.h"
#include "apps/batch/run_batch.h"
#include "apps/batch/stop_signal.h"
#include "apps/cli/commands.h"
#include "apps/cli/option_checks.h"
#include "apps/cli/plan_text.h"
#include "dismantle/documents/check_report.h"
#include "dismantle/documents/path_file.h"
#include "dismantle/files/atomic_file.h"
#include "dismantle/planner/plan_disassembly.h"
#include "dismantle/planner/plan_path.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

namespace dismantle::cli {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

struct BatchCommand {
  CommonOptions common;
  std::string folder, output;
  batch::BatchSelection selection;
  batch::BatchLimits limits;
  double lease_seconds = batch::BatchJob{}.lease_seconds;
  double clearance = 0, time_limit = 0;
  int workers = 0;
  bool check_only = false, retry = false;
};

std::string folders_text(const std::vector<fs::path>& folders) {
  std::string text;
  for (const fs::path& folder : folders) text += folder.string() + ';';
  return text;
}

/// Everything but the input that a result depends on.
std::string options_text(const BatchCommand& c) {
  return fmt::format(
      "dismantle {} units={} deflection={} angular={} solids={} drop-duplicates={} tolerance={} pairs={} simplify={} "
      "clearance={} time-limit={} check-only={} memory={} cpu-time={} references={}",
      DISMANTLE_VERSION, c.common.import.units, c.common.import.deflection, c.common.import.angular_deflection,
      static_cast<int>(c.common.import.solids), c.common.import.drop_duplicates, c.common.tolerance,
      static_cast<int>(c.common.pairs), c.common.simplify, c.clearance, c.time_limit, c.check_only, c.limits.memory_gib,
      c.limits.cpu_seconds, folders_text(c.common.import.reference_folders));
}

Result<Done> write_json(const fs::path& file, const Json& json) {
  return write_file(file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

/// Plans, writes the plan and adds its numbers to the summary.
Result<Done> plan(const BatchCommand& command, const Assembly& assembly, const PairStates& states,
                  const fs::path& folder, Json& summary) {
  PlanOptions options;
  options.time_limit = command.time_limit;
  options.engine = {make_executor(command.common), widest_lanes()};
  options.progress = progress_printer(command.common);
  const Plan plan = plan_disassembly(assembly, states, options);
  const Path path = plan_path(assembly, states, plan);
  if (Result<Done> written = write_path(folder / "plan.path.json", path); !written) return written;
  if (Result<Done> written = write_json(folder / "plan.json", plan_json(assembly, plan, path)); !written)
    return written;
  summary.update({{"steps", plan.steps.size()},
                  {"removed", path.removed.size()},
                  {"staying", plan.staying.size()},
                  {"complete", plan.complete()},
                  {"out_of_time", plan.out_of_time}});
  return Done{};
}

/// Checks and plans one assembly, in a process whose output is discarded.
Result<std::string> process_item(BatchCommand command, const batch::BatchItem& item, const fs::path& folder) {
  command.common.assembly_file = item.input.string();
  const Result<Assembly> assembly = load(command.common);
  if (!assembly) return assembly.error();
  const Result<PairStates> states = classify(*assembly, command.common, command.clearance);
  if (!states) return states.error();
  const Result<Clashes> clashes = clashes_of(*assembly, command.common, command.clearance);
  if (!clashes) return clashes.error();
  Result<Done> written = write_file(folder / "check.json", check_report_json(*assembly, *clashes));
  if (!written) return written.error();

  const ClashCounts pairs = count_clashes(*clashes);
  Json summary{{"components", assembly->components.size()},
               {"triangles", triangle_count(*assembly)},
               {"tolerance_mm", states->tolerance},
               {"near", pairs.near},
               {"contact", pairs.contact},
               {"overlapping", pairs.overlapping},
               {"contained", pairs.contained}};
  if (!command.check_only) written = plan(command, *assembly, *states, folder, summary);
  if (!written) return written.error();
  return summary.dump();
}

/// The result of an item in one line.
std::string report_line(const batch::BatchResult& result) {
  if (result.failed()) return "failed: " + result.error;
  const Json s = Json::parse(result.summary, nullptr, false);
  std::string line = fmt::format("{} components; pairs: {} in contact, {} overlapping", s.value("components", 0),
                                 s.value("contact", 0), s.value("overlapping", 0));
  if (s.contains("steps"))
    line += fmt::format("; {} removed in {} steps, {} not removed{}", s.value("removed", 0), s.value("steps", 0),
                        s.value("staying", 0), s.value("out_of_time", false) ? " (time limit reached)" : "");
  return line;
}

/// Prints a line for each item, on stderr if stdout gets JSON.
batch::BatchReport line_printer(const BatchCommand& command, const batch::BatchJob& job) {
  auto count = std::make_shared<std::size_t>(0);
  std::FILE* const stream = command.common.json ? stderr : stdout;
  return [&job, count, stream](std::uint32_t i, batch::BatchProgress progress) {
    const std::optional<batch::BatchResult> result = find_result(job, job.items[i]);
    fmt::print(stream, "[{}/{}] {}: {}{}\n", ++*count, job.items.size(), job.items[i].name,
               progress == batch::BatchProgress::Found ? "(done before) " : "", result ? report_line(*result) : "");
    std::fflush(stream);
  };
}

Result<ExitCode> run(const BatchCommand& command, const batch::LaunchedRank& rank) {
  batch::BatchSelection selection = command.selection;
  selection.except = command.output;
  Result<std::vector<batch::BatchItem>> items =
      batch::find_batch_items(command.folder, selection, options_text(command));
  if (!items) return items.error();
  batch::BatchJob job{std::move(*items), command.output, {}, command.limits, command.lease_seconds};
  job.work = [&command](const batch::BatchItem& item, const fs::path& folder) {
    return process_item(command, item, folder);
  };
  batch::BatchRunOptions options;
  options.workers = command.workers > 0 ? command.workers : batch::usable_cores(rank);
  options.retry_failed = command.retry;
  if (rank.rank == 0 && !command.common.quiet) options.report = line_printer(command, job);

  const Result<batch::BatchTables> tables = batch::run_batch(job, options);
  if (!tables && rank.rank != 0 && batch::stop_requested()) return ExitCode::Failed;  // rank 0 reports it
  if (!tables) return tables.error();
  if (rank.rank != 0) return ExitCode::Done;  // rank 0 prints the results
  if (command.common.json) {
    fmt::print("{}", tables->json);
  } else {
    fmt::print("{} assemblies, {} failed; table: {}\n", job.items.size(), tables->failed,
               (fs::path(command.output) / "batch.tsv").string());
  }
  return tables->failed == 0 ? ExitCode::Done : ExitCode::No;
}

void add_work_options(CLI::App& command, BatchCommand& options) {
  command.add_flag("--check-only", options.check_only, "Check only, do not plan");
  command.add_option("--clearance", options.clearance, "Also list pairs that are apart by at most this")
      ->type_name("MM")
      ->check(not_negative());
  command.add_option("--time-limit", options.time_limit, "Time limit of the search for a plan; keeps what was found")
      ->type_name("S")
      ->check(above_zero());
}

void add_batch_options(CLI::App& command, BatchCommand& options) {
  static const std::map<std::string, batch::MeshGrouping> kMeshes{{"folder", batch::MeshGrouping::Folder},
                                                                  {"file", batch::MeshGrouping::File}};
  command.add_option("--only", options.selection.only, "Only assemblies whose path in FOLDER matches this pattern")
      ->type_name("PATTERN");
  command
      .add_option("--meshes", options.selection.meshes,
                  "Mesh files of a folder form one assembly (folder), or one each (file)")
      ->transform(choice(kMeshes))
      ->type_name("folder|file");
  command
      .add_option("--workers", options.workers,
                  "Assemblies processed in parallel on this machine (default: one per core)")
      ->type_name("N")
      ->check(between(1, 4096));
  command.add_flag("--retry", options.retry, "Retry assemblies that failed");
  command.add_option("--memory", options.limits.memory_gib, "Memory limit for one assembly")
      ->type_name("GIB")
      ->check(above_zero())
      ->capture_default_str();
  command.add_option("--cpu-time", options.limits.cpu_seconds, "Processor time limit for one assembly")
      ->type_name("S")
      ->check(above_zero())
      ->capture_default_str();
  command
      .add_option("--lease", options.lease_seconds,
                  "Time without a sign of life after which another machine takes over an assembly")
      ->type_name("S")
      ->check(above_zero())
      ->capture_default_str();
}

}  // namespace

void add_batch_command(CLI::App& app, ExitCode& exit_code) {
  CLI::App* command =
      app.add_subcommand("batch", "Check and plan every assembly below a folder, on all cores and hosts");
  auto options = std::make_shared<BatchCommand>();
  options->common.threads = 1;
  command->add_option("FOLDER", options->folder, "Folder with the assemblies")->required();
  command
      ->add_option("-o,--output", options->output, "Folder for the results: a subfolder for each assembly, and tables")
      ->required()
      ->type_name("FOLDER");
  add_work_options(*command, *options);
  add_batch_options(*command, *options);
  add_common_options(*command, options->common);
  command->get_option("--threads")->description("Threads for one assembly (default: 1)");
  command->footer(
      "Finished assemblies are skipped. Several hosts can share one output folder: mpirun --enable-recovery "
      "dismantle batch ... (docs/batch.md).\nExit code 0: all assemblies were processed; 1: some failed, with the "
      "reason.");
  command->callback([options, &exit_code] {
    const batch::LaunchedRank rank = batch::launched_rank();
    const Result<ExitCode> result = run(*options, rank);
    exit_code = result ? *result : report(result.error());
  });
}

}  // namespace dismantle::cli
