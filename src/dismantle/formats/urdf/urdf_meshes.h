// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"
#include "dismantle/formats/import/imported_assembly.h"
#include "dismantle/formats/import/mesh_source.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace dismantle {

/// The mesh files that a URDF file refers to: OBJ, STL and PLY, whose numbers are metres, and COLLADA.
class UrdfMeshes {
 public:
  /// @param urdf the file that refers to the meshes
  UrdfMeshes(const std::filesystem::path& urdf, const ImportOptions& options);

  /// The parts of the mesh file of an address, as in the URDF [m]. A COLLADA file is scaled from its own unit to
  /// metres, the transforms of its nodes are applied, and its up axis is ignored, as RViz does. Errors: Unreadable.
  Result<std::vector<MeshPart>> load(const std::string& address);

  /// The files that were read, and those that would have been read in their place if they were there.
  std::vector<LinkedFile> linked_files() const;

 private:
  Result<std::vector<MeshPart>> read(const std::filesystem::path& file, const std::string& address);
  Result<std::vector<MeshPart>> read_collada_parts(const std::filesystem::path& file);

  std::string urdf_name_;
  std::filesystem::path base_;                  // of relative addresses
  std::vector<std::filesystem::path> folders_;  // in which the meshes may be
  ImportOptions options_;
  std::map<std::filesystem::path, std::string> hashes_;  // by file; empty: not there
};

}  // namespace dismantle
