// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"
#include "dismantle/formats/import/imported_assembly.h"
#include "dismantle/formats/import/mesh_source.h"

#include <filesystem>
#include <string>
#include <vector>

namespace dismantle {

/// A mesh file's bytes and the parts found in them.
struct MeshFile {
  std::string bytes;                     ///< The whole file.
  std::vector<MeshPart> parts;           ///< In the order of the file.
  std::vector<LinkedFile> linked_files;  ///< OBJ: its MTL files, also those that are not there.
};

/// True if the extension is that of a mesh file: .obj, .stl or .ply, in upper or lower case.
bool is_mesh_file(const std::filesystem::path& file);

/// Reads one OBJ, STL or PLY file, by its extension; OBJ colours from the MTL file beside it, if there is one. Parts
/// without a name get the file's stem. Errors: Unreadable (see the parsers), Failed if cancelled.
/// @pre is_mesh_file(file)
Result<MeshFile> read_mesh_file(const std::filesystem::path& file, const ImportOptions& options);

/// Reads an assembly from one OBJ, STL or PLY file: a component for each part; millimetres, unless the options say
/// otherwise. Errors: as read_mesh_file and AssemblyBuilder. @pre is_mesh_file(file)
Result<Assembly> read_mesh(const std::filesystem::path& file, const ImportOptions& options);

/// Reads an assembly from a folder of OBJ, STL and PLY files: a component for each file, named after its stem, in byte
/// order of the file names. Other files and subfolders are ignored. Errors: as read_mesh; Unreadable if the folder has
/// no mesh file.
Result<Assembly> read_mesh_folder(const std::filesystem::path& folder, const ImportOptions& options);

}  // namespace dismantle
