// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"
#include "dismantle/formats/import/mesh_source.h"

#include <string>
#include <unordered_map>
#include <vector>

namespace dismantle {

/// What an OBJ file holds.
struct ObjModel {
  std::vector<MeshPart> parts;              ///< One a section with faces, in file order.
  std::vector<std::string> material_files;  ///< As `mtllib` names them.
};

/// Reads Wavefront OBJ: one part an `o` section or, where there is no `o`, a `g` section; faces before the first
/// section are a part without name. Vertices may be named from the end (negative), faces may name vertices that come
/// later, lines may be continued with a backslash; polygons are cut into triangles. Texture coordinates, normals,
/// lines, points, curves and unknown statements are skipped. A part's material is that of its first face. Errors:
/// Unreadable with the line: a coordinate that is no finite number, an index out of range, more triangles than the
/// limit.
Result<ObjModel> parse_obj(const MeshSource& source, const ImportOptions& options);

/// The diffuse colours (Kd, d) of an MTL file by material name. Decoration: what cannot be understood is skipped.
std::unordered_map<std::string, Color> parse_mtl(std::string_view text);

}  // namespace dismantle
