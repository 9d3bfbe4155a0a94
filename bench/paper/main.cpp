// SPDX-License-Identifier: Apache-2.0
// The evaluation of Du et al. 2015: plays the motions of the four sample assemblies with every method.
//   bench_paper [--only table1|figure9|cores|sizes|appends|tunnels]... [--cores N]... [--repeats N] [--moves N]
//               [--assembly NAME]... [--name NAME] [--largest TRIANGLES] [--samples FOLDER] [--out FOLDER] [--busy]
// Without --only: all parts. Prints every row as it is measured, and writes PART.csv, and PART.json with the machine
// and the command, into --out (docs/evaluation), from which tools/make_evaluation writes docs/evaluation.md; a run that
// is ended early leaves its rows there. A part may be measured in pieces: with --name, its files are PART-NAME.csv and
// PART-NAME.json. --cores, which may be repeated: the counts of cores (all of the machine). --repeats (3): plays of
// each motion. --moves: only the first moves of each motion. --assembly: only these in table1 and figure9. --largest
// (1000000): ten million triangles need 10 GB of memory. --samples: the folder of the samples, as .step or .dasm files.
// Where other programs keep more than half a core busy, it measures only with --busy, and no page is written from it.
#include "bench/command_line.h"
#include "bench/paper/evaluation.h"
#include "bench/paper/machine_load.h"
#include "bench/paper/paper_scenes.h"
#include "dismantle/exec/cuda_device.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <map>
#include <thread>

namespace dismantle {
namespace {

constexpr double kIdle = 0.5;         // most cores that other programs may keep busy
constexpr double kIdleSeconds = 2.0;  // for which it is measured

struct Settings {
  EvaluationOptions options;
  std::vector<EvaluationPart> parts;
  std::string out = DISMANTLE_SOURCE_DIR "/docs/evaluation";
  std::string name;       // of a piece; empty: of none
  std::size_t moves = 0;  // 0: all
  bool busy = false;
  std::string command;
};

bool parse(int argc, char** argv, Settings& settings) {
  const int all_cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  EvaluationOptions& options = settings.options;
  options.samples_folder = DISMANTLE_SOURCE_DIR "/samples";
  options.repeats = 3;
  options.cores.clear();
  std::map<std::string, EvaluationPart> parts;
  for (const EvaluationPart part : kEvaluationParts) parts[name_of(part)] = part;
  bench::CommandLine line(
      "bench_paper [--only table1|figure9|cores|sizes|appends|tunnels]... [--cores N]... [--repeats N] [--moves N]\n"
      "                   [--assembly NAME]... [--name NAME] [--largest TRIANGLES] [--samples FOLDER] [--out FOLDER]\n"
      "                   [--busy]");
  line.choices("--only", settings.parts, parts);
  line.numbers("--cores", options.cores);
  line.option("--repeats", options.repeats, 1);
  line.option("--moves", settings.moves, 1);
  std::map<std::string, std::string> assemblies;
  for (const PaperAssembly& assembly : paper_assemblies()) assemblies[assembly.name] = assembly.name;
  line.choices("--assembly", options.assemblies, assemblies);
  line.option("--name", settings.name);
  line.option("--largest", options.largest, 1);
  line.option("--samples", options.samples_folder);
  line.option("--out", settings.out);
  line.flag("--busy", settings.busy);
  if (!line.parse(argc, argv)) return false;
  if (settings.parts.empty()) settings.parts.assign(std::begin(kEvaluationParts), std::end(kEvaluationParts));
  if (options.cores.empty()) options.cores.push_back(all_cores);
  std::sort(options.cores.begin(), options.cores.end());
  if (settings.moves > 0) options.moves = settings.moves;
  settings.command = "bench_paper";
  for (int i = 1; i < argc; ++i) settings.command += std::string(" ") + argv[i];
  return true;
}

/// A text in quotes for JSON.
std::string quoted(const std::string& text) {
  std::string json = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') json += '\\';
    json += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return json + "\"";
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  char text[16];
  std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&now));
  return text;
}

/// The circumstances of a part's results, as JSON.
std::string setting_json(const Settings& settings, const EvaluationTable& found, bool complete, double busy) {
  const Result<std::string> gpu = cuda_device_name();
  char numbers[200];
  std::snprintf(numbers, sizeof numbers, "\"cores\": %u, \"repeats\": %d, \"moves\": %zu, \"busy_cores\": %.2f",
                std::thread::hardware_concurrency(), settings.options.repeats, settings.moves, busy);
  return "{\n  \"command\": " + quoted(settings.command) + ",\n  \"date\": " + quoted(today()) +
         ",\n  \"processor\": " + quoted(processor_name()) + ",\n  \"gpu\": " + quoted(gpu ? *gpu : "") +
         ",\n  \"compiler\": " + quoted(__VERSION__) + ",\n  " + numbers +
         ",\n  \"complete\": " + (complete ? "true" : "false") +
         ",\n  \"equal_poses\": " + (found.equal_poses ? "true" : "false") + "\n}\n";
}

/// Writes the files of a part. @return false where they cannot be written
bool write_files(const Settings& settings, EvaluationPart part, const EvaluationTable& found, bool complete,
                 double busy) {
  const std::string piece = settings.name.empty() ? "" : "-" + settings.name;
  const std::string file = (std::filesystem::path(settings.out) / (name_of(part) + piece)).string();
  return write_result(file + ".csv", csv_of(found.table)) &&
         write_result(file + ".json", setting_json(settings, found, complete, busy));
}

int cannot_write(const Settings& settings) {
  std::fprintf(stderr,
               "bench_paper: nothing can be written in %s (no folder, or no permission); name another one with --out\n",
               settings.out.c_str());
  return bench::kExitFailed;
}

int run(const Settings& settings) {
  std::error_code ignored;  // what cannot be made cannot be written either
  std::filesystem::create_directories(settings.out, ignored);
  if (access(settings.out.c_str(), W_OK) != 0) return cannot_write(settings);
  bool equal_poses = true;
  for (const EvaluationPart part : settings.parts) {
    const double busy = busy_cores(kIdleSeconds);
    if (busy > kIdle && !settings.busy && part != EvaluationPart::Tunnels) {
      std::fprintf(
          stderr,
          "bench_paper: other programs keep %.1f cores busy (times would be too long); end them, or measure with "
          "--busy, for no page\n",
          busy);
      return bench::kExitFailed;
    }
    const auto keep = [&](const EvaluationTable& so_far) { write_files(settings, part, so_far, false, busy); };
    const Result<EvaluationTable> found = evaluate(part, settings.options, keep);
    if (!found) {
      std::fprintf(stderr, "bench_paper: %s\n", found.error().message.c_str());
      return bench::kExitUnreadable;
    }
    if (!write_files(settings, part, *found, true, busy)) return cannot_write(settings);
    equal_poses = equal_poses && found->equal_poses;
  }
  if (equal_poses) return 0;
  std::fprintf(stderr, "bench_paper: methods that must stop at the same poses did not\n");
  return bench::kExitFailed;
}

}  // namespace
}  // namespace dismantle

int main(int argc, char** argv) {
  dismantle::Settings settings;
  return dismantle::parse(argc, argv, settings) ? dismantle::run(settings) : dismantle::bench::kExitUsage;
}
