// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace dismantle {

/// Loads a file that a glTF document refers to, of at most `limit` bytes; `uri` is decoded and relative.
using GltfFileLoader = std::function<Result<std::string>(const std::string& uri, std::size_t limit)>;

/// Reads glTF 2.0 from memory, JSON or binary: read_gltf without file access and the hash. `name` is the file's name
/// without its folder.
Result<Assembly> import_gltf(std::string_view bytes, const std::string& name, const GltfFileLoader& load,
                             const ImportOptions& options);

}  // namespace dismantle
