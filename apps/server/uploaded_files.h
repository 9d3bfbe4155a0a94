// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"

#include <filesystem>

namespace dismantle::server {

/// Unpacks the body of POST /api/open_files (docs/wire.md) into a folder, which is created. Errors: Usage if the body
/// is malformed, a path leaves the folder, or there are too many files; Failed if a file cannot be written.
Result<Done> unpack_files(const std::filesystem::path& body, const std::filesystem::path& folder);

/// The assembly among files that belong together: the only file that may be one, such as a URDF with its meshes; or the
/// folder of the meshes. Errors: Usage if there is none, or a choice.
Result<std::filesystem::path> assembly_among(const std::filesystem::path& folder);

}  // namespace dismantle::server
