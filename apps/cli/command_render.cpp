// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/commands.h"
#include "dismantle/render/assembly_scene.h"
#include "dismantle/render/render.h"

#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

namespace dismantle::cli {

namespace {

constexpr int kLargestSide = 16384;  // of a picture [pixels]

struct RenderCommand {
  CommonOptions common;
  std::string output;
  std::string view = "iso";
  std::string section;
  std::string size = "1200x900";
  double explode = 0;
  bool perspective = false;
  std::vector<std::string> ghosts;
};

/// Reads a whole word as a number.
template <class T>
bool parse_number(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

Result<Done> parse_size(std::string_view text, RenderOptions& options) {
  const std::size_t cross = text.find('x');
  if (cross == std::string_view::npos || !parse_number(text.substr(0, cross), options.width) ||
      !parse_number(text.substr(cross + 1), options.height) || options.width < 1 || options.height < 1 ||
      options.width > kLargestSide || options.height > kLargestSide)
    return Error{ErrorKind::Usage, fmt::format("--size {} is no picture size (two numbers from 1 to {}); "
                                               "write it like 1200x900",
                                               text, kLargestSide)};
  return Done{};
}

/// "Y" cuts through the middle, "Y=12.5" there.
Result<SectionPlane> parse_section(std::string_view text, const Camera& camera, Vec3 middle) {
  const char letter = text.empty() ? ' ' : static_cast<char>(text[0] | 0x20);
  const int axis = letter - 'x';
  Vec3 direction, point = middle;
  const bool has_axis = axis >= 0 && axis < 3;
  if (has_axis) direction[axis] = 1;
  const bool has_place = has_axis && text.size() > 2 && text[1] == '=' && parse_number(text.substr(2), point[axis]);
  if (!has_axis || !(has_place || text.size() == 1))
    return Error{ErrorKind::Usage,
                 fmt::format("--section {} is no plane (an axis and a place in mm); write it like Y=12.5", text)};
  return section_facing(camera, direction, point);
}

Result<RenderScene> compose_scene(const Assembly& assembly, const RenderCommand& command) {
  AssemblySceneOptions options;
  options.explode = command.explode;
  RenderScene scene = make_scene(assembly, options);
  for (const std::string& name : command.ghosts) {
    const std::optional<ComponentId> id = assembly.find(name);
    if (!id)
      return Error{ErrorKind::Usage, fmt::format("there is no component {} (--ghost takes component names); "
                                                 "'dismantle info' lists them",
                                                 name)};
    make_ghost(scene.items[id->value]);
  }
  return scene;
}

Result<Done> run(const RenderCommand& command) {
  RenderOptions options;
  if (const Result<Done> size = parse_size(command.size, options); !size) return size.error();
  const Result<Executor> executor = make_executor(command.common);
  if (!executor) return executor.error();
  options.executor = *executor;
  const Result<Assembly> assembly = load(command.common);
  if (!assembly) return assembly.error();
  Result<RenderScene> scene = compose_scene(*assembly, command);
  if (!scene) return scene.error();

  CameraFit fit;
  fit.direction = view_direction(*standard_view(command.view));
  fit.projection = command.perspective ? Projection::Perspective : Projection::Orthographic;
  fit.aspect = static_cast<double>(options.width) / options.height;
  const Camera camera = fit_camera(item_points(scene->items), fit);
  if (!command.section.empty()) {
    const Result<SectionPlane> plane = parse_section(command.section, camera, assembled_bounds(*assembly).center());
    if (!plane) return plane.error();
    scene->section = *plane;
  }
  return write_png(render(*scene, camera, options), command.output);
}

}  // namespace

void add_render_command(CLI::App& app, ExitCode& exit_code) {
  CLI::App* command = app.add_subcommand("render", "A picture of an assembly as a PNG file");
  auto options = std::make_shared<RenderCommand>();
  add_assembly_argument(*command, options->common);
  command->add_option("-o,--output", options->output, "PNG file to write")->required()->type_name("FILE.png");
  command->add_option("--view", options->view, "Where it is seen from")
      ->check(CLI::IsMember({"iso", "front", "back", "left", "right", "top", "bottom"}))
      ->capture_default_str();
  command->add_option("--size", options->size, "Size of the picture in pixels")
      ->type_name("WxH")
      ->capture_default_str();
  command->add_option("--explode", options->explode, "Move components apart by this times their distance to the middle")
      ->type_name("FACTOR")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--section", options->section, "Cut it open across an axis, in the middle or at a place in mm")
      ->type_name("X|Y|Z[=MM]");
  command->add_option("--ghost", options->ghosts, "Components to look through")->type_name("NAME...");
  command->add_flag("--perspective", options->perspective, "As a camera sees it, not as a drawing");
  add_common_options(*command, options->common);
  command->callback([options, &exit_code] {
    const Result<Done> done = run(*options);
    if (!done) {
      exit_code = report(done.error());
    } else if (options->common.json) {
      fmt::print("{}\n",
                 nlohmann::ordered_json{
                     {"format", "dismantle-render"}, {"version", 1}, {"file", options->output}, {"size", options->size}}
                     .dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    }
  });
}

}  // namespace dismantle::cli
