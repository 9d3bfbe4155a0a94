// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"

#include <filesystem>
#include <vector>

namespace dismantle {

/// The folders in which a model's references are looked up, with links resolved: its own, and
/// ImportOptions::reference_folders. A URDF file's own folder is its ROS package: the nearest folder at or above it
/// that has a package.xml, if there is one. Empty for formats whose files refer to nothing.
std::vector<std::filesystem::path> reference_folders(const std::filesystem::path& model, const ImportOptions& options);

/// The regular file to which a model refers by `address`, a decoded path: absolute, or relative to `base`, a folder. It
/// lies in one of the folders and is reached there through no symbolic link, so that a model that came from elsewhere
/// reads only what belongs to it. Errors: Unreadable, "is not ...; <what to do>", to be said of the address.
Result<std::filesystem::path> referenced_file(const std::filesystem::path& address, const std::filesystem::path& base,
                                              const std::vector<std::filesystem::path>& folders);

}  // namespace dismantle
