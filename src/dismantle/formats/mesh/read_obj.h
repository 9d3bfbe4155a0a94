// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"
#include "dismantle/formats/import/mesh_source.h"

#include <string>
#include <unordered_map>
#include <vector>

namespace dismantle {

/// The contents of an OBJ file.
struct ObjModel {
  std::vector<MeshPart> parts;              ///< One for each section with faces, in file order.
  std::vector<std::string> material_files;  ///< Named by `mtllib`.
};

/// Reads Wavefront OBJ: one part for each `o` section or, without `o`, each `g` section; faces before the first section
/// are a part without name. Vertex indices may be negative (relative) or refer to later vertices, lines may be
/// continued with a backslash; polygons are triangulated. Texture coordinates, normals, lines, points, curves and
/// unknown statements are skipped. A part's material is that of its first face. Errors: Unreadable with the line: a
/// coordinate that is not finite, an index out of range, more triangles than the limit.
Result<ObjModel> parse_obj(const MeshSource& source, const ImportOptions& options);

/// The diffuse colours (Kd, d) of an MTL file by material name. Malformed entries are skipped.
std::unordered_map<std::string, Color> parse_mtl(std::string_view text);

}  // namespace dismantle
