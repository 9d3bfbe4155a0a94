// SPDX-License-Identifier: Apache-2.0
// The evaluation of Du et al. 2015 in one command: plays the motions of the four sample assemblies with every method
// and writes docs/evaluation.md with its tables and pictures.
//   bench_paper [--cores N] [--repeats N] [--largest TRIANGLES] [--docs FOLDER]
// Prints every row as it is measured, and the page at the end. Takes some ten minutes on two cores; ten million
// triangles need `--largest 10000000` and 10 GB of memory.
#include "bench/command_line.h"
#include "bench/paper/evaluation_page.h"
#include "dismantle/files/atomic_file.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <thread>

namespace dismantle {
namespace {

struct Settings {
  EvaluationOptions options;
  std::string docs = DISMANTLE_SOURCE_DIR "/docs";
};

bool parse(int argc, char** argv, Settings& settings) {
  settings.options.cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  settings.options.samples_folder = DISMANTLE_SOURCE_DIR "/samples";
  bench::CommandLine line("bench_paper [--cores N] [--repeats N] [--largest TRIANGLES] [--docs FOLDER]");
  line.option("--cores", settings.options.cores, 1);
  line.option("--repeats", settings.options.repeats, 1);
  line.option("--largest", settings.options.largest, 1);
  line.option("--docs", settings.docs);
  return line.parse(argc, argv);
}

/// The command as it was given.
std::string command_of(int argc, char** argv) {
  std::string command = argv[0];
  for (int i = 1; i < argc; ++i) command += std::string(" ") + argv[i];
  return command;
}

Result<Done> run(const Settings& settings, const std::string& command) {
  EvaluationSetting setting = present_setting(command, settings.options.cores);
  const Result<Evaluation> evaluation = evaluate(settings.options);
  if (!evaluation) return evaluation.error();
  setting.load_after = present_load();
  for (const EvaluationFile& file : evaluation_files(*evaluation, setting)) {
    const std::filesystem::path path = std::filesystem::path(settings.docs) / file.path;
    std::error_code ignored;  // writing reports it
    std::filesystem::create_directories(path.parent_path(), ignored);
    const Result<Done> written = write_file(path, file.text);
    if (!written) return written.error();
  }
  std::printf("\n%s", evaluation_page(*evaluation, setting).c_str());
  return Done{};
}

}  // namespace
}  // namespace dismantle

int main(int argc, char** argv) {
  using namespace dismantle;
  Settings settings;
  if (!parse(argc, argv, settings)) return bench::kExitUsage;
  const Result<Done> done = run(settings, command_of(argc, argv));
  if (done) return 0;
  std::fprintf(stderr, "bench_paper: %s\n", done.error().message.c_str());
  return static_cast<int>(done.error().kind) + 2;
}
