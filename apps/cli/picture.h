// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/cli/command.h"
#include "dismantle/render/image.h"
#include "dismantle/render/scene.h"

#include <string>

namespace dismantle::cli {

/// Options of a picture.
struct PictureOptions {
  std::string view = "iso";
  std::string section;
  std::string size = "1200x900";
  bool perspective = false;
};

/// Declares --view, --size, --section and --perspective on a command. `options` must outlive the parse.
void add_picture_options(CLI::App& command, PictureOptions& options);

/// The picture of a scene that is all seen; cuts go through the middle of `middle_of` where no place is given. Errors:
/// Usage.
Result<Image> take_picture(RenderScene scene, const Aabb& middle_of, const PictureOptions& options,
                           const Executor& executor);

}  // namespace dismantle::cli
