// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/commands.h"
#include "apps/cli/option_checks.h"
#include "apps/cli/picture.h"
#include "apps/cli/plan_text.h"
#include "dismantle/render/assembly_scene.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

namespace dismantle::cli {

namespace {

struct RenderCommand {
  CommonOptions common;
  std::string output;
  PictureOptions picture;
  double explode = 0;
  std::vector<std::string> ghosts;
};

Result<RenderScene> compose_scene(const Assembly& assembly, const RenderCommand& command) {
  AssemblySceneOptions options;
  options.explode = command.explode;
  RenderScene scene = make_scene(assembly, options);
  for (const std::string& name : command.ghosts) {
    const Result<ComponentId> id = find_component(assembly, name);
    if (!id) return id.error();
    make_ghost(scene.items[id->value]);
  }
  return scene;
}

Result<Done> run(const RenderCommand& command) {
  const Executor executor = make_executor(command.common);
  const Result<Assembly> assembly = load(command.common);
  if (!assembly) return assembly.error();
  Result<RenderScene> scene = compose_scene(*assembly, command);
  if (!scene) return scene.error();
  const Result<Image> picture = take_picture(std::move(*scene), assembled_bounds(*assembly), command.picture, executor);
  if (!picture) return picture.error();
  return write_png(*picture, command.output);
}

}  // namespace

void add_render_command(CLI::App& app, ExitCode& exit_code) {
  CLI::App* command = app.add_subcommand("render", "Render a picture of an assembly as a PNG file");
  auto options = std::make_shared<RenderCommand>();
  add_assembly_argument(*command, options->common);
  command->add_option("-o,--output", options->output, "PNG file to write")->required()->type_name("FILE.png");
  add_picture_options(*command, options->picture);
  command
      ->add_option("--explode", options->explode,
                   "Explode: move components away from the center by this factor of their distance")
      ->type_name("FACTOR")
      ->check(not_negative());
  command->add_option("--ghost", options->ghosts, "Components to draw transparent")->type_name("NAME...");
  add_common_options(*command, options->common);
  command->callback([options, &exit_code] {
    const Result<Done> done = run(*options);
    if (!done) {
      exit_code = report(done.error());
    } else if (options->common.json) {
      fmt::print("{}\n", nlohmann::ordered_json{{"format", "dismantle-render"},
                                                {"version", 1},
                                                {"file", options->output},
                                                {"size", options->picture.size}}
                             .dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    }
  });
}

}  // namespace dismantle::cli
