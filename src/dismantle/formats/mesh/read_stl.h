// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"
#include "dismantle/formats/import/mesh_source.h"

#include <vector>

namespace dismantle {

/// True if the bytes are a binary STL: their number matches the triangle count at byte 80, the header has a zero byte,
/// or they do not start with the word "solid" of the ASCII form. (Binary files whose header starts with "solid" exist.)
bool is_binary_stl(std::string_view bytes);

/// Reads STL, ASCII (one part for each solid, with its name) or binary (one part without name). Every triangle has its
/// own vertices; cleaning welds them. Normals and attributes are skipped. Errors: Unreadable with the line or the
/// triangle: a file that ends early, a coordinate that is not finite, more triangles than the limit.
Result<std::vector<MeshPart>> parse_stl(const MeshSource& source, const ImportOptions& options);

}  // namespace dismantle
