// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"
#include "dismantle/formats/import/imported_assembly.h"
#include "dismantle/formats/import/mesh_source.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace dismantle {

/// Loads the parts of a mesh file that a URDF refers to (a relative or absolute path, or a package:// or file://
/// address), in metres.
using MeshLoader = std::function<Result<std::vector<MeshPart>>(const std::string& address)>;

/// Reads URDF text: one component for each visual (a mesh, box, cylinder or sphere), placed with every joint at zero;
/// metres to millimetres.
/// - The visual of a link that has no other is named after the link. Several are below a group named after the link,
///   each with its own name, the stem of its mesh file, or else the name of the link; with Solids::Join, they are one
///   component, named after the link, with the colour of the one that has the largest surface.
/// - The colour is that of the visual's material, or else that of the largest part of its mesh file.
/// - Round primitives are tessellated; the error goes into Assembly::deflection.
/// Errors: Unreadable with the link, joint or line: malformed XML, a joint without its links, a link with two parents,
/// a loop, a malformed number, a mesh that cannot be read.
Result<Assembly> parse_urdf(const MeshSource& source, const ImportOptions& options, const MeshLoader& load_mesh);

/// Reads a URDF file and the COLLADA, OBJ, STL and PLY files that it refers to (UrdfMeshes): relative to its folder,
/// and package://NAME/PATH in the folder NAME, or the folder that holds the file, at or above it. COLLADA files are
/// read as by read_collada(), and need a process of its own as there.
Result<ImportedAssembly> read_urdf(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace dismantle
