// SPDX-License-Identifier: Apache-2.0
// The paper's evaluation in one command: plays the four sample assemblies' motions with every method and writes
// docs/evaluation.md with its tables and pictures. Prints every row as it is measured, and the page in the end.
//   bench_paper [--cores N] [--repeats N] [--largest TRIANGLES] [--docs FOLDER]
// Takes some ten minutes on two cores; ten million triangles need `--largest 10000000` and 10 GB of memory.
#include "bench/paper/evaluation_page.h"
#include "dismantle/files/atomic_file.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
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
  for (int i = 1; i < argc; i += 2) {
    if (i + 1 == argc) return false;
    const std::string option = argv[i], value = argv[i + 1];
    if (option == "--cores") {
      settings.options.cores = std::max(1, std::atoi(value.c_str()));
    } else if (option == "--repeats") {
      settings.options.repeats = std::max(1, std::atoi(value.c_str()));
    } else if (option == "--largest") {
      settings.options.largest = std::strtoull(value.c_str(), nullptr, 10);
    } else if (option == "--docs") {
      settings.docs = value;
    } else {
      return false;
    }
  }
  return true;
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
    std::error_code ignored;  // writing tells
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
  if (!parse(argc, argv, settings)) {
    std::fprintf(stderr, "usage: bench_paper [--cores N] [--repeats N] [--largest TRIANGLES] [--docs FOLDER]\n");
    return 2;
  }
  const Result<Done> done = run(settings, command_of(argc, argv));
  if (done) return 0;
  std::fprintf(stderr, "bench_paper: %s\n", done.error().message.c_str());
  return static_cast<int>(done.error().kind) + 2;
}
