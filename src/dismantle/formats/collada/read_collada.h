// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"

#include <filesystem>

namespace dismantle {

/// Reads a COLLADA file through Assimp: one component for each node with a
/// mesh, with the node's name, world transform, and the diffuse colour of the largest part of its surface; the nodes as
/// tree. Coordinates are scaled from the file's unit, unless `options.units` overrides it; its axes are kept, whichever
/// is up. Assimp is used in this process and may crash on hostile files: for a process of its own; load_assembly()
/// starts one. Errors: Unreadable, also where dismantle was built without Assimp; Usage for unknown units.
Result<Assembly> read_collada(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace dismantle
