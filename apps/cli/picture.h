// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/cli/command.h"
#include "dismantle/render/image.h"
#include "dismantle/render/scene.h"

#include <string>

namespace dismantle::cli {

/// Options of a picture, as given on the command line.
struct PictureOptions {
  std::string view = "iso";       ///< Name of a standard view.
  std::string section;            ///< "X|Y|Z[=MM]"; empty: no section plane.
  std::string size = "1200x900";  ///< "WIDTHxHEIGHT" in pixels.
  bool perspective = false;       ///< Perspective instead of parallel projection.
};

/// Declares --view, --size, --section and --perspective on a command. `options` must outlive the parse.
void add_picture_options(CLI::App& command, PictureOptions& options);

/// Renders a whole scene. A section plane without a position goes through the center of `bounds`. Errors: Usage if an
/// option is malformed.
Result<Image> take_picture(RenderScene scene, const Aabb& bounds, const PictureOptions& options,
                           const Executor& executor);

}  // namespace dismantle::cli
