// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/picture.h"

#include "apps/cli/option_checks.h"
#include "dismantle/render/assembly_scene.h"
#include "dismantle/render/render.h"

#include <fmt/format.h>

#include <charconv>

namespace dismantle::cli {

namespace {

constexpr int kMaxSide = 16384;  // of a picture [pixels]

/// Parses a complete text as a number.
template <class T>
bool parse_number(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

Result<Done> parse_size(std::string_view text, RenderOptions& options) {
  const std::size_t cross = text.find('x');
  if (cross == std::string_view::npos || !parse_number(text.substr(0, cross), options.width) ||
      !parse_number(text.substr(cross + 1), options.height) || options.width < 1 || options.height < 1 ||
      options.width > kMaxSide || options.height > kMaxSide)
    return Error{ErrorKind::Usage, fmt::format("--size {} is not a picture size (two numbers from 1 to {}); "
                                               "write it like 1200x900",
                                               text, kMaxSide)};
  return Done{};
}

/// Parses a section plane: "Y" goes through `center`, "Y=12.5" through that position.
Result<SectionPlane> parse_section(std::string_view text, const Camera& camera, Vec3 center) {
  const char letter = text.empty() ? ' ' : static_cast<char>(text[0] | 0x20);
  const int axis = letter - 'x';
  Vec3 direction, point = center;
  const bool has_axis = axis >= 0 && axis < 3;
  if (has_axis) direction[axis] = 1;
  const bool has_position = has_axis && text.size() > 2 && text[1] == '=' && parse_number(text.substr(2), point[axis]);
  if (!has_axis || !(has_position || text.size() == 1))
    return Error{ErrorKind::Usage,
                 fmt::format("--section {} is not a plane (an axis and a position in mm); write it like Y=12.5", text)};
  return section_facing(camera, direction, point);
}

}  // namespace

void add_picture_options(CLI::App& command, PictureOptions& options) {
  command.add_option("--view", options.view, "Direction of view")
      ->type_name("iso|front|back|left|right|top|bottom")
      ->check(one_of({"iso", "front", "back", "left", "right", "top", "bottom"}))
      ->capture_default_str();
  command.add_option("--size", options.size, "Size of the picture in pixels")->type_name("WxH")->capture_default_str();
  command
      .add_option("--section", options.section,
                  "Section plane perpendicular to an axis, in the middle or at a position in mm")
      ->type_name("X|Y|Z[=MM]");
  command.add_flag("--perspective", options.perspective, "Perspective instead of parallel projection");
}

Result<Image> take_picture(RenderScene scene, const Aabb& bounds, const PictureOptions& options,
                           const Executor& executor) {
  RenderOptions render_options;
  if (const Result<Done> size = parse_size(options.size, render_options); !size) return size.error();
  render_options.executor = executor;
  CameraFit fit;
  fit.direction = view_direction(*standard_view(options.view));
  fit.projection = options.perspective ? Projection::Perspective : Projection::Orthographic;
  fit.aspect = static_cast<double>(render_options.width) / render_options.height;
  const Camera camera = fit_camera(item_points(scene.items), fit);
  if (!options.section.empty()) {
    const Result<SectionPlane> plane = parse_section(options.section, camera, bounds.center());
    if (!plane) return plane.error();
    scene.section = *plane;
  }
  return render(scene, camera, render_options);
}

}  // namespace dismantle::cli
