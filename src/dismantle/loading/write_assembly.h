// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/mesh/write_options.h"

#include <filesystem>

namespace dismantle {

/// Writes the assembly in its assembled pose [mm], by extension (upper or lower case): .obj, .stl, .ply, .glb; without
/// extension, a new folder with an OBJ file for each component. write_mesh.h and write_glb.h say what each format
/// keeps. A file appears whole or not at all. Errors: Usage for an unknown extension, Failed if it cannot be written.
Result<Done> write_assembly(const std::filesystem::path& file, const Assembly& assembly,
                            const WriteOptions& options = {});

}  // namespace dismantle
