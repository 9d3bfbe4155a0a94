// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/commands.h"
#include "apps/cli/instructions.h"
#include "apps/cli/option_checks.h"
#include "apps/cli/picture.h"
#include "apps/server/viewer_files.h"

#include "dismantle/documents/path_file.h"
#include "dismantle/export/exported_file.h"
#include "dismantle/export/step_scene.h"
#include "dismantle/export/swept_volume.h"
#include "dismantle/files/atomic_file.h"
#include "dismantle/files/display_name.h"
#include "dismantle/files/number_text.h"
#include "dismantle/formats/import/file_formats.h"
#include "dismantle/formats/mesh/write_mesh.h"
#include "dismantle/render/assembly_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

namespace dismantle::cli {

namespace fs = std::filesystem;

namespace {

struct ExportCommand {
  CommonOptions common;
  std::string path_file;
  std::string output;
  std::optional<ExportFormat> format;
  bool reverse = false;
  bool clearance = false;
  std::size_t step = 0;  ///< From 1; 0: not given.
  double within = 0;     ///< [mm]; 0: default.
  InstructionsCommand instructions;
  PictureOptions picture;
};

/// The input of an export: an assembly, and its path if there is one.
struct ExportInput {
  Assembly assembly;
  std::optional<Path> path;
  Timeline timeline;    ///< Of the path.
  std::string product;  ///< Its name in titles.
};

Result<ExportFormat> check(const ExportCommand& command) {
  const std::optional<ExportFormat> format = command.format ? command.format : export_format_of(command.output);
  if (!format)
    return Error{ErrorKind::Usage, command.output + " cannot be written (unknown file extension); use " +
                                       export_endings() + ", or give --format"};
  if (command.path_file.empty() && needs_path(*format))
    return Error{ErrorKind::Usage,
                 "there is no path to export (only an assembly is given, and this format needs "
                 "moves); also give a *.path.json"};
  if (command.reverse && (command.path_file.empty() || !depends_on_direction(*format)))
    return Error{ErrorKind::Usage,
                 "--reverse has nothing to reverse (there is no path, or the format has no moves); leave it out"};
  if (command.clearance && *format != ExportFormat::Moves)
    return Error{ErrorKind::Usage,
                 "--clearance does not apply to this format (only to the table of moves); "
                 "leave it out, or write a .csv"};
  const bool is_swept = *format == ExportFormat::SweptStl;
  if (command.step > 0 && ((*format != ExportFormat::Png && !is_swept) || command.path_file.empty()))
    return Error{ErrorKind::Usage,
                 "--step does not apply here (only to a picture or a swept volume of a path); "
                 "leave it out, or write a .png or .stl of a path"};
  if (const std::string option = command.instructions.given();
      !option.empty() && *format != ExportFormat::InstructionsHtml && *format != ExportFormat::InstructionsPdf)
    return Error{ErrorKind::Usage, option +
                                       " does not apply to this format (only to work instructions); leave it out, "
                                       "or write a .pdf or instructions.html"};
  if (command.within > 0 && !is_swept)
    return Error{ErrorKind::Usage,
                 "--within does not apply to this format (only to swept volumes); "
                 "leave it out, or write an .stl"};
  return *format;
}

/// Reads the input. For a path without an assembly, the assembly in its folder.
Result<ExportInput> read(ExportCommand command) {
  ExportInput exported;
  if (!command.path_file.empty()) {
    Result<Path> path = read_path(command.path_file);
    if (!path) return path.error();
    exported.path = std::move(*path);
  }
  if (command.common.assembly_file.empty()) {
    const Result<fs::path> beside = assembly_beside(command.path_file, *exported.path);
    if (!beside) return beside.error();
    command.common.assembly_file = beside->string();
  }
  exported.product =
      command.instructions.product.empty() ? product_name(command.common.assembly_file) : command.instructions.product;
  Result<Assembly> assembly = load(command.common);
  if (!assembly) return assembly.error();
  exported.assembly = std::move(*assembly);
  if (!exported.path) return exported;

  note_other_version(*exported.path, exported.assembly);
  Result<Timeline> timeline = Timeline::of_path(exported.assembly, *exported.path);
  if (!timeline) return timeline.error();
  exported.timeline = std::move(*timeline);
  return exported;
}

PathDirection direction(const ExportCommand& command) {
  return command.reverse ? PathDirection::Reversed : PathDirection::Forward;
}

Error no_such_step(std::size_t step, std::size_t count) {
  return {ErrorKind::Usage, fmt::format("there is no step {} (the path has {}); give one from 1 to that", step, count)};
}

Result<std::string> png(const ExportInput& exported, const ExportCommand& command) {
  const Executor executor = make_executor(command.common);
  const std::size_t count = exported.timeline.moves().size();
  if (command.step > count) return no_such_step(command.step, count);
  AssemblySceneOptions options;
  if (command.reverse)
    options.poses = exported.timeline.poses_at(exported.timeline.end(), exported.assembly.components.size());
  RenderScene scene = command.step > 0
                          ? step_scene(exported.assembly, exported.timeline, command.step - 1, direction(command))
                          : make_scene(exported.assembly, options);
  const Result<Image> picture =
      take_picture(std::move(scene), assembled_bounds(exported.assembly), command.picture, executor);
  if (!picture) return picture.error();
  const std::vector<std::uint8_t> bytes = encode_png(*picture);
  return std::string(bytes.begin(), bytes.end());
}

Result<std::vector<MoveClearance>> clearances(const ExportInput& exported, const CommonOptions& common) {
  const Result<PairStates> states = classify(exported.assembly, common);
  if (!states) return states.error();
  const Executor executor = make_executor(common);
  auto found = move_clearances(exported.assembly, *states, exported.timeline, {executor, widest_lanes()},
                               progress_printer(common));
  if (!found) return Error{ErrorKind::Failed, "the table was not written (cancelled); run the command again"};
  return std::move(*found);
}

Result<std::string> content(ExportFormat format, const ExportInput& exported, const ExportCommand& command) {
  if (format == ExportFormat::Png) return png(exported, command);
  if (has_own_writer(format))
    return instructions_text(exported.assembly, exported.timeline, direction(command), exported.product, format,
                             command.instructions, command.common);
  ExportOptions options;
  options.direction = direction(command);
  options.viewer = server::viewer_files();
  options.progress = progress_printer(command.common);
  if (command.clearance) {
    Result<std::vector<MoveClearance>> found = clearances(exported, command.common);
    if (!found) return found.error();
    options.clearances = std::move(*found);
  }
  return exported_file(format, exported.assembly, exported.path.value_or(Path{}), options);
}

Result<SweptVolume> swept(const ExportInput& exported, const ExportCommand& command) {
  const std::size_t count = exported.timeline.moves().size();
  if (command.step == 0 && count != 1)
    return Error{ErrorKind::Usage,
                 fmt::format("the move to sweep is not given (the path has {}); give --step N, from 1", count)};
  if (command.step > count) return no_such_step(command.step, count);
  const TimelineMove& move = exported.timeline.moves()[std::max<std::size_t>(command.step, 1) - 1];
  return swept_volume(exported.assembly, move, {command.within, progress_printer(command.common)});
}

/// Writes the swept volume of a move and prints its error bound.
Result<Done> write_swept(const ExportInput& exported, const ExportCommand& command) {
  Result<SweptVolume> volume = swept(exported, command);
  if (!volume) return volume.error();
  const std::size_t triangles = volume->mesh.faces.size();
  Assembly solid;
  solid.components.push_back(
      {"swept volume", std::make_shared<const TriangleMesh>(std::move(volume->mesh)), {}, {}, 0, {}});
  const Result<Done> written = write_stl(command.output, solid, StlForm::Binary);
  if (!written) return written.error();

  if (command.common.json) {
    using Json = nlohmann::ordered_json;
    const Json report{{"format", "dismantle-export"},           {"version", 1}, {"file", command.output},
                      {"bytes", fs::file_size(command.output)}, {"moves", 1},   {"triangles", triangles},
                      {"within_mm", volume->tolerance}};
    fmt::print("{}\n", report.dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    fmt::print("wrote {}: {} triangles, at most {:.3g} mm outside the exact swept volume\n", command.output, triangles,
               volume->tolerance);
  }
  return Done{};
}

Result<Done> run(const ExportCommand& command) {
  const Result<ExportFormat> format = check(command);
  if (!format) return format.error();
  const Result<ExportInput> exported = read(command);
  if (!exported) return exported.error();
  if (*format == ExportFormat::SweptStl) return write_swept(*exported, command);
  const Result<std::string> bytes = content(*format, *exported, command);
  if (!bytes) return bytes.error();
  const Result<Done> written = write_file(command.output, *bytes);
  if (!written) return written.error();

  const std::size_t moves = exported->timeline.moves().size();
  if (command.common.json) {
    using Json = nlohmann::ordered_json;
    const Json report{{"format", "dismantle-export"},
                      {"version", 1},
                      {"file", command.output},
                      {"bytes", bytes->size()},
                      {"moves", moves}};
    fmt::print("{}\n", report.dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    const bool shows_moves = exported->path.has_value() && depends_on_direction(*format);
    fmt::print("wrote {}: {}{}, {} bytes\n", command.output,
               count_text(exported->assembly.components.size(), "component"),
               shows_moves ? ", " + count_text(moves, "move") : "", bytes->size());
  }
  return Done{};
}

/// Handles a path given alone, in place of the assembly.
void sort_arguments(ExportCommand& command) {
  if (command.path_file.empty() && is_path_file(command.common.assembly_file))
    std::swap(command.path_file, command.common.assembly_file);
}

}  // namespace

void add_export_command(CLI::App& app, ExitCode& exit_code) {
  static const std::map<std::string, ExportFormat> kFormats{{"glb", ExportFormat::Glb},
                                                            {"html", ExportFormat::Html},
                                                            {"png", ExportFormat::Png},
                                                            {"swept", ExportFormat::SweptStl},
                                                            {"moves", ExportFormat::Moves},
                                                            {"bom-csv", ExportFormat::BillCsv},
                                                            {"bom-json", ExportFormat::BillJson},
                                                            {"path", ExportFormat::Path},
                                                            {"instructions", ExportFormat::InstructionsHtml},
                                                            {"instructions-pdf", ExportFormat::InstructionsPdf}};
  CLI::App* command = app.add_subcommand(
      "export", "Export an assembly and its path: animation, page, instructions, pictures, tables, path file");
  auto options = std::make_shared<ExportCommand>();
  command
      ->add_option("ASSEMBLY", options->common.assembly_file,
                   format_names(", ") + ", or a folder of meshes; or PATH alone, with the assembly in its folder")
      ->required();
  command->add_option("PATH", options->path_file, "Path written by a session, move or plan (*.path.json)");
  command
      ->add_option("-o,--output", options->output,
                   "File to write: .glb (animated), .html (a page that plays it), .pdf or instructions.html (work "
                   "instructions), .png (a picture), .stl (the swept volume of "
                   "a move), .csv (a row a move), bom.csv or "
                   "bom.json (bill of materials), "
                   ".path.json")
      ->required()
      ->type_name("FILE");
  command->add_option("--format", options->format, "Format of the file (default: from its extension)")
      ->transform(choice(kFormats))
      ->type_name("glb|html|png|swept|moves|bom-csv|bom-json|path|instructions|instructions-pdf");
  command->add_flag("--reverse", options->reverse,
                    "Assembly instead of disassembly: moves reversed, last first (.path.json: both)");
  command->add_flag("--clearance", options->clearance, "Table of moves: add the minimum clearance of each");
  command->add_option("--step", options->step, "Picture or swept volume of step N")
      ->type_name("N")
      ->check(above_zero());
  command
      ->add_option("--within", options->within,
                   "Swept volume: largest distance outside the exact one [mm] (default: 2% of its diagonal)")
      ->type_name("MM")
      ->check(above_zero());
  add_instructions_options(*command, options->instructions);
  add_picture_options(*command, options->picture);
  add_common_options(*command, options->common);
  command->callback([options, &exit_code] {
    sort_arguments(*options);
    if (const Result<Done> done = run(*options); !done) exit_code = report(done.error());
  });
}

}  // namespace dismantle::cli
