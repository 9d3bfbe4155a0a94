// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/io/import_options.h"

#include <filesystem>

namespace dismantle {

/// Reads glTF 2.0 (.gltf with its buffers, .glb): one component a node with a mesh (its triangle primitives together),
/// node name, world transform, base colour; metres scaled to mm.
Result<Assembly> read_gltf(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace dismantle
