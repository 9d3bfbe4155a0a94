// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/display_name.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace dismantle {

namespace fs = std::filesystem;

namespace {

/// Names of folders that say what is in them, not of which product it is.
constexpr std::string_view kCommonNames[] = {"cad", "components", "files", "mesh", "meshes", "models",
                                             "obj", "original",   "parts", "ply",  "step",   "stl"};

bool is_common(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  return std::find(std::begin(kCommonNames), std::end(kCommonNames), name) != std::end(kCommonNames);
}

}  // namespace

std::string display_name(const fs::path& file) {
  std::error_code error;
  const fs::path full = fs::canonical(file, error);
  if (error || !fs::is_directory(full, error) || !full.has_relative_path()) return file.filename().string();
  const fs::path parent = full.parent_path().filename();
  return (parent.empty() ? full.filename() : parent / full.filename()).generic_string();
}

std::string product_name(const fs::path& file) {
  std::error_code error;
  const fs::path full = fs::canonical(file, error);
  if (error || !fs::is_directory(full, error)) return file.stem().string();
  const fs::path parent = full.parent_path().filename();
  return (is_common(full.filename().string()) && !parent.empty() ? parent : full.filename()).string();
}

}  // namespace dismantle
