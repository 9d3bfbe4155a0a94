// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"

#include <filesystem>
#include <string>
#include <vector>

namespace dismantle {

/// A file that another file refers to, as it was read.
struct LinkedFile {
  std::filesystem::path file;  ///< Absolute.
  std::string sha256;          ///< Of its bytes; empty for one that was looked for and is not there.
};

/// The result of reading a file.
struct ImportedAssembly {
  Assembly assembly;                     ///< As the file has it.
  std::vector<LinkedFile> linked_files;  ///< Files besides it on which the assembly depends.
};

}  // namespace dismantle
