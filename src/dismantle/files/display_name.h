// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace dismantle {

/// How users know a file: its name. For a folder, the name of its parent, too, as many are called just "parts":
/// "vice/parts".
std::string display_name(const std::filesystem::path& file);

/// The name of the product in a file, for titles: the file's name without extension; the name of a folder, or of its
/// parent if it is called what folders of meshes are often called ("parts", "meshes", "stl" ...).
std::string product_name(const std::filesystem::path& file);

}  // namespace dismantle
