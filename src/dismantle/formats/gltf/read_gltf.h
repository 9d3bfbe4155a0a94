// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"

#include <filesystem>

namespace dismantle {

/// Reads glTF 2.0 (.gltf with its buffers, .glb): one component for each node with a mesh (its triangle primitives
/// together), node name, world transform, base colour of the largest part of its surface; metres scaled to mm unless
/// `options.units` says otherwise, axes unchanged. Nodes share their mesh where their transforms differ by a rigid
/// motion; scales, shears and mirrorings go into the mesh. Skins and morph targets stay in their rest pose. Buffers
/// beside the file and in data URIs are read, nothing is fetched; images are ignored. Errors: Unreadable; for a
/// compressed file the message names the extension that it requires.
Result<Assembly> read_gltf(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace dismantle
