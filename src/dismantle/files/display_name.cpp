// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/display_name.h"

namespace dismantle {

namespace fs = std::filesystem;

std::string display_name(const fs::path& file) {
  std::error_code error;
  const fs::path full = fs::canonical(file, error);
  if (error || !fs::is_directory(full, error) || !full.has_relative_path()) return file.filename().string();
  const fs::path parent = full.parent_path().filename();
  return (parent.empty() ? full.filename() : parent / full.filename()).generic_string();
}

}  // namespace dismantle
