// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"

#include <filesystem>

namespace dismantle {

/// Reads an assembly in any supported format (docs/formats.md), by extension (upper or lower case) or as a folder of
/// meshes. Vertices are welded, degenerate triangles dropped and counted; open and non-manifold meshes are reported in
/// the component's faults, never refused.
///
/// The file is parsed by a program of its own (find_reader()) in a child process: a file that crashes a reader, or
/// makes it compute or allocate without end (import_budget()), is an Error. The kernel confines that process to reading
/// the model and what belongs to it (reference_folders()), where it can (confine()). What OpenCASCADE and Assimp made
/// of a file, or of the files that it refers to, is kept in `options.cache_folder`, and taken from there while neither
/// the file nor any linked file has changed. Errors: Unreadable with one sentence; Usage for unknown units; Failed if
/// cancelled, or if the program cannot be started.
Result<Assembly> load_assembly(const std::filesystem::path& file, const ImportOptions& options = {});

}  // namespace dismantle
