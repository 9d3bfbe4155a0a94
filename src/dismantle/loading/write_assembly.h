// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/path.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/mesh/write_options.h"

#include <filesystem>

namespace dismantle {

/// Writes the assembly in its assembled pose [mm], by extension (upper or lower case): .obj, .stl, .ply, .glb, .dasm;
/// without extension, a new folder with an OBJ file for each component. write_mesh.h, write_glb.h and assembly_file.h
/// say what each format keeps. A file appears whole or not at all.
/// @param motion kept in a .dasm file; may be null
/// Errors: Usage for an unknown extension and for a motion in any other format; Failed if it cannot be written.
Result<Done> write_assembly(const std::filesystem::path& file, const Assembly& assembly,
                            const WriteOptions& options = {}, const Motion* motion = nullptr);

}  // namespace dismantle
