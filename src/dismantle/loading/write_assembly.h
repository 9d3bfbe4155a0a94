// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/mesh/write_options.h"

#include <filesystem>

namespace dismantle {

/// Writes the assembly in its assembled pose [mm], by the extension (any case): .obj, .stl, .ply, .glb; without
/// extension, a new folder with an OBJ file a component. See write_mesh.h and write_glb.h for what each keeps. Whole or
/// not at all. Errors: Usage for an unknown extension, Failed where it cannot be written.
Result<Done> write_assembly(const std::filesystem::path& file, const Assembly& assembly,
                            const WriteOptions& options = {});

}  // namespace dismantle
