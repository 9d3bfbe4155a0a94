// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dismantle::batch {

/// One assembly of a batch.
struct BatchItem {
  std::string name;             ///< Path relative to the folder of the batch, with '/'.
  std::filesystem::path input;  ///< Argument of load_assembly: a file, or a folder of meshes.
  std::string folder;           ///< Name of its folder in the output folder; unique in the batch.
  std::string key;              ///< SHA-256 of input and options: a result with another key is outdated.
  std::uint64_t bytes = 0;      ///< Size of the input.
};

/// The treatment of mesh files (OBJ, STL, PLY) in one folder.
enum class MeshGrouping {
  Folder,  ///< Together one assembly, a component a file. A single one is named by its file.
  File,    ///< Each an assembly of its own.
};

/// Selects the assemblies of a batch.
struct BatchSelection {
  MeshGrouping meshes = MeshGrouping::Folder;  ///< How mesh files form assemblies.
  std::string only;                            ///< Shell pattern for the names of items; empty: all.
  std::filesystem::path except;                ///< A folder that is not searched: the output of the batch.
};

/// Finds every assembly below `root`, in byte order of the names. Hidden files and folders are skipped, links to
/// folders not followed. A key covers `options` and the names, sizes and modification times of the item's files; for
/// formats that refer to other files, of all files that they may refer to: glTF, in its own folder and below; URDF,
/// below the top-level folder of `root` that contains it. Errors: Unreadable if `root` is not a readable folder, or no
/// assembly is found.
Result<std::vector<BatchItem>> find_batch_items(const std::filesystem::path& root, const BatchSelection& selection,
                                                const std::string& options);

}  // namespace dismantle::batch
