// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"

#include <filesystem>

namespace dismantle {

/// Reads an assembly in any supported format (docs/formats.md), by extension (upper or lower case) or as a folder of
/// meshes. Vertices are welded, degenerate triangles dropped and counted; open and
/// non-manifold meshes are reported in the component's faults, never refused. Errors: Unreadable with one sentence;
/// memory is allocated only in proportion to the file's size.
Result<Assembly> load_assembly(const std::filesystem::path& file, const ImportOptions& options = {});

}  // namespace dismantle
