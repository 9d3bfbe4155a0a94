// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/commands.h"
#include "dismantle/files/atomic_file.h"
#include "samples/bundled/bundled_sample.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace dismantle::cli {

namespace {

struct SampleCommand {
  std::string name;
  std::string output;
  std::string motion_output;
  bool json = false;
  bool quiet = false;
};

void list_samples(bool json) {
  if (!json) {
    for (const BundledSample& sample : bundled_samples()) fmt::print("{:<12}{}\n", sample.name, sample.description);
    return;
  }
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const BundledSample& sample : bundled_samples())
    list.push_back({{"name", sample.name}, {"description", sample.description}});
  fmt::print("{}\n", list.dump(2));
}

/// A file that was written.
struct SavedFile {
  std::string name;
  std::size_t bytes = 0;
};

Result<SavedFile> save(const Result<std::string>& text, const std::string& file) {
  if (!text) return text.error();
  if (const Result<Done> written = write_file(file, *text); !written) return written.error();
  return SavedFile{file, text->size()};
}

void print_saved(const std::vector<SavedFile>& files, const SampleCommand& options) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const SavedFile& file : files) {
    list.push_back({{"file", file.name}, {"bytes", file.bytes}});
    if (!options.json && !options.quiet) fmt::print("{}: {} bytes\n", file.name, file.bytes);
  }
  if (options.json)
    fmt::print("{}\n", nlohmann::ordered_json{{"format", "dismantle-sample"}, {"version", 1}, {"files", list}}.dump(
                           2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

Result<Done> run(const SampleCommand& options) {
  if (options.name.empty()) {
    if (!options.output.empty() || !options.motion_output.empty())
      return Error{ErrorKind::Usage, "the sample is not named (only a file to write); give NAME before -o"};
    list_samples(options.json);
    return Done{};
  }
  const Result<std::string> step = bundled_sample_step(options.name);
  if (!step) return step.error();
  const std::string file =
      options.output.empty() && options.motion_output.empty() ? options.name + ".step" : options.output;
  std::vector<SavedFile> files;
  if (!file.empty()) {
    const Result<SavedFile> saved = save(step, file);
    if (!saved) return saved.error();
    files.push_back(*saved);
  }
  if (!options.motion_output.empty()) {
    const Result<SavedFile> saved = save(bundled_sample_motion(options.name), options.motion_output);
    if (!saved) return saved.error();
    files.push_back(*saved);
  }
  print_saved(files, options);
  return Done{};
}

}  // namespace

void add_sample_command(CLI::App& app, ExitCode& exit_code) {
  CLI::App* command = app.add_subcommand("sample", "Write a bundled sample assembly; without NAME, list them");
  auto options = std::make_shared<SampleCommand>();
  command->add_option("NAME", options->name, "microscope, tooling, lathe or robot");
  command->add_option("-o,--output", options->output, "STEP file to write (default: NAME.step)")->type_name("FILE");
  command->add_option("--motion", options->motion_output, "Also write the sample's motion file, for 'dismantle move'")
      ->type_name("FILE");
  command->add_flag("--json", options->json, "Print the result as JSON");
  command->add_flag("--quiet", options->quiet, "Print errors only");
  command->callback([options, &exit_code] {
    if (const Result<Done> done = run(*options); !done) exit_code = report(done.error());
  });
}

}  // namespace dismantle::cli
