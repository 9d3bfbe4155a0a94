// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"
#include "dismantle/formats/import/mesh_source.h"

#include <filesystem>

namespace dismantle {

/// Reads VRML 2.0 (VRML97) from memory: read_vrml without file access and the hash.
Result<Assembly> import_vrml(const MeshSource& source, const ImportOptions& options);

/// Reads a VRML 2.0 (VRML97) file: one component for each occurrence of a Shape with polygons or a solid, named by DEF
/// or after the node around it, with its diffuse colour; groups as tree. Open Shapes without a name in the same group
/// are one component: many programs write a Shape for each face or colour of a part. In metres, as the standard says,
/// unless the options say otherwise: many CAD programs write millimetres. Errors: see parse_vrml; Usage for unknown
/// units.
Result<Assembly> read_vrml(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace dismantle
