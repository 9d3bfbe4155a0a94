// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/mesh/write_options.h"

#include <filesystem>

/// Writers of meshes in the assembled pose [mm]. Each file appears whole or not at all. Errors: Failed.
namespace dismantle {

/// Wavefront OBJ: one `o` section for each component. Coordinates read back as the same doubles.
Result<Done> write_obj(const std::filesystem::path& file, const Assembly& assembly);

/// STL: binary (float32, all components in one), or ASCII with a solid for each component, whose coordinates read back
/// as the same doubles.
Result<Done> write_stl(const std::filesystem::path& file, const Assembly& assembly, StlForm form);

/// Binary little-endian PLY with float64 coordinates; all components in one, each vertex with its component's colour.
Result<Done> write_ply(const std::filesystem::path& file, const Assembly& assembly);

/// A new folder with an OBJ file for each component, named after it (file_stem; repeats get "#2", "#3", ...). Errors:
/// also if something other than an empty folder already has the name.
Result<Done> write_mesh_folder(const std::filesystem::path& folder, const Assembly& assembly);

}  // namespace dismantle
