// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/formats/gltf/gltf_document.h"

#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// The triangles of a glTF mesh and the colour of most of its surface.
struct GltfSurface {
  TriangleMesh mesh;  ///< In metres, not welded or cleaned.
  Color color;
};

/// Reads the triangle primitives of a mesh, together. Errors: Unreadable where accessors or indices reach too far, a
/// position is no finite number, or there are more than `triangle_limit` triangles.
Result<GltfSurface> read_gltf_mesh(const GltfDocument& document, std::size_t mesh,
                                   const std::vector<std::string_view>& buffers, const std::string& file_name,
                                   std::size_t triangle_limit);

}  // namespace dismantle
