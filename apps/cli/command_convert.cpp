// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/commands.h"
#include "dismantle/documents/motion_file.h"
#include "dismantle/loading/write_assembly.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

namespace dismantle::cli {

namespace {

struct ConvertCommand {
  CommonOptions common;
  std::string output;
  std::string motion_file;
  WriteOptions write;
};

Result<Assembly> run(const ConvertCommand& command) {
  Result<Assembly> assembly = load(command.common);
  if (!assembly) return assembly;
  std::optional<Motion> motion;
  if (!command.motion_file.empty()) {
    Result<Motion> read = read_motion(command.motion_file);
    if (!read) return read.error();
    if (const Result<Done> named = check_names(*read, *assembly); !named) return named.error();
    motion = std::move(*read);
  }
  const Result<Done> written = write_assembly(command.output, *assembly, command.write, motion ? &*motion : nullptr);
  if (!written) return written.error();
  return assembly;
}

void print_text(const Assembly& assembly, const std::string& output) {
  fmt::print("{}: {} components, {} triangles, from {}\n", output, assembly.components.size(), triangle_count(assembly),
             assembly.source_file);
}

void print_json(const Assembly& assembly, const std::string& output) {
  using Json = nlohmann::ordered_json;
  const Json report{{"format", "dismantle-convert"},
                    {"version", 1},
                    {"file", output},
                    {"components", assembly.components.size()},
                    {"triangles", triangle_count(assembly)}};
  fmt::print("{}\n", report.dump(2, ' ', false, Json::error_handler_t::replace));
}

}  // namespace

void add_convert_command(CLI::App& app, ExitCode& exit_code) {
  CLI::App* command = app.add_subcommand("convert", "Write an assembly as meshes in its assembled pose, in mm");
  auto options = std::make_shared<ConvertCommand>();
  add_assembly_argument(*command, options->common);
  command
      ->add_option("-o,--output", options->output,
                   "File to write: .glb (components, tree and colours), .obj (one section per component), .stl, .ply "
                   "(everything in "
                   "one), or without extension a new folder of OBJ files")
      ->required()
      ->type_name("FILE");
  command->add_option("--motion", options->motion_file, "Keep this motion in the .dasm file")->type_name("FILE");
  command->add_flag(
      "--ascii", [options](std::int64_t) { options->write.stl = StlForm::Ascii; },
      "ASCII STL with one solid per component, instead of binary");
  add_common_options(*command, options->common);
  command->callback([options, &exit_code] {
    const Result<Assembly> assembly = run(*options);
    if (!assembly) {
      exit_code = report(assembly.error());
    } else if (options->common.json) {
      print_json(*assembly, options->output);
    } else {
      print_text(*assembly, options->output);
    }
  });
}

}  // namespace dismantle::cli
