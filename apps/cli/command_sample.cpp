// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/commands.h"
#include "dismantle/files/atomic_file.h"
#include "samples/bundled/bundled_sample.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

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

Result<Done> save(const Result<std::string>& text, const std::string& file, bool quiet) {
  if (!text) return text.error();
  Result<Done> written = write_file(file, *text);
  if (written && !quiet) fmt::print("{}: {} bytes\n", file, text->size());
  return written;
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
  if (!file.empty())
    if (const Result<Done> saved = save(step, file, options.quiet); !saved) return saved.error();
  if (options.motion_output.empty()) return Done{};
  return save(bundled_sample_motion(options.name), options.motion_output, options.quiet);
}

}  // namespace

void add_sample_command(CLI::App& app, ExitCode& exit_code) {
  CLI::App* command = app.add_subcommand("sample", "Write a bundled sample assembly; without NAME, list them");
  auto options = std::make_shared<SampleCommand>();
  command->add_option("NAME", options->name, "microscope, tooling, lathe or robot");
  command->add_option("-o,--output", options->output, "STEP file to write (default: NAME.step)");
  command->add_option("--motion", options->motion_output, "Also write the sample's motion file, for 'dismantle move'");
  command->add_flag("--json", options->json, "List the samples as JSON");
  command->add_flag("--quiet", options->quiet, "Print errors only");
  command->callback([options, &exit_code] {
    if (const Result<Done> done = run(*options); !done) exit_code = report(done.error());
  });
}

}  // namespace dismantle::cli
