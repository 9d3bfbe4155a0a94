// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/formats/gltf/gltf_document.h"

#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// Reads the triangle primitives of a mesh into one [m]. Errors: Unreadable if accessors or indices are out of range, a
/// position is not finite, or there are more than `triangle_limit` triangles.
Result<SceneMesh> read_gltf_mesh(const GltfDocument& document, std::size_t mesh,
                                 const std::vector<std::string_view>& buffers, const std::string& file_name,
                                 std::size_t triangle_limit);

}  // namespace dismantle
