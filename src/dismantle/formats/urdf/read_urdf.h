// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"
#include "dismantle/formats/import/mesh_source.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace dismantle {

/// Gives the parts of the mesh file that a URDF names (a relative or absolute path, or a package:// or file://
/// address).
using MeshLoader = std::function<Result<std::vector<MeshPart>>(const std::string& address)>;

/// Reads URDF text: one component a link with visuals (meshes, boxes, cylinders, spheres, all of a link together),
/// named after the link, where it stands when every joint is at zero; metres to millimetres. The colour is that of the
/// link's first visual. Round primitives are tessellated; how far off goes into Assembly::deflection. Errors:
/// Unreadable with the link, joint or line: no XML, a joint without its links, a link with two parents, a loop, a
/// number that is none, a mesh that cannot be read.
Result<Assembly> parse_urdf(const MeshSource& source, const ImportOptions& options, const MeshLoader& load_mesh);

/// Reads a URDF file and the OBJ, STL and PLY files that it names: relative to its folder, and package://NAME/PATH in
/// the folder NAME, or the folder that holds the file, at or above it.
Result<Assembly> read_urdf(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace dismantle
