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
  std::string name;             ///< Its place below the folder of the batch, with '/'.
  std::filesystem::path input;  ///< What load_assembly reads: a file, or a folder of meshes.
  std::string folder;           ///< Of its results, within the output folder; unique within the batch.
  std::string key;              ///< Changes where the result may: of the input and the options.
  std::uint64_t bytes = 0;      ///< Of the input.
};

/// The treatment of mesh files (OBJ, STL, PLY) in one folder.
enum class MeshGrouping {
  Folder,  ///< As one assembly, a component a file; a mesh file alone in its folder is an assembly by itself.
  File,    ///< Each as an assembly by itself.
};

struct BatchSelection {
  MeshGrouping meshes = MeshGrouping::Folder;
  std::string only;              ///< Takes the items whose name this shell pattern matches; empty: all.
  std::filesystem::path except;  ///< This folder is not looked into: the batch's own output.
};

/// Every assembly below `root`, in byte order of the names. Hidden files and folders are passed over, links to folders
/// not followed. A key covers `options` and the name, size and time of change of the item's files; for formats that
/// name other files, of all that it might name: glTF, in its own folder and below; URDF, below the folder of `root`
/// that it is in. Errors: Unreadable where `root` is no folder that can be read, or holds no assembly.
Result<std::vector<BatchItem>> find_batch_items(const std::filesystem::path& root, const BatchSelection& selection,
                                                const std::string& options);

}  // namespace dismantle::batch
