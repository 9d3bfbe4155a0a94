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

/// Loads the parts of a mesh file that a URDF refers to (a relative or absolute path, or a package:// or file://
/// address).
using MeshLoader = std::function<Result<std::vector<MeshPart>>(const std::string& address)>;

/// Reads URDF text: one component for each link with visuals (meshes, boxes, cylinders, spheres, all of a link
/// together), named after the link, placed with every joint at zero; metres to millimetres. The colour is that of the
/// link's first visual. Round primitives are tessellated; the error goes into Assembly::deflection. Errors:
/// Unreadable with the link, joint or line: malformed XML, a joint without its links, a link with two parents, a loop,
/// a malformed number, a mesh that cannot be read.
Result<Assembly> parse_urdf(const MeshSource& source, const ImportOptions& options, const MeshLoader& load_mesh);

/// Reads a URDF file and the OBJ, STL and PLY files that it refers to: relative to its folder, and package://NAME/PATH
/// in the folder NAME, or the folder that holds the file, at or above it.
Result<Assembly> read_urdf(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace dismantle
