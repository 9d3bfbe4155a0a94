// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"
#include "dismantle/formats/import/mesh_source.h"

namespace dismantle {

/// Reads PLY 1.0, ASCII or binary of either byte order: the coordinates x, y, z of "vertex" in any number type and the
/// list vertex_indices (or vertex_index) of "face"; polygons are triangulated. Other elements and properties are
/// skipped, in any order. Errors: Unreadable with the position: a file that ends early or declares more than it holds,
/// a coordinate that is not finite, an index out of range, more triangles than the limit.
Result<MeshPart> parse_ply(const MeshSource& source, const ImportOptions& options);

}  // namespace dismantle
