// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace dismantle::bench {

/// The name by which tables call an assembly: of a file its stem, of a folder `parts` the name of the folder above it.
inline std::string assembly_name(const std::filesystem::path& file) {
  return (file.filename() == "parts" ? file.parent_path().filename() : file.stem()).string();
}

}  // namespace dismantle::bench
