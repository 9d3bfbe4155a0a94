// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace dismantle::server {

/// The assemblies that were opened last, newest first, kept in a file from run to run.
class RecentFiles {
 public:
  /// Without a folder nothing is kept.
  explicit RecentFiles(const std::optional<std::filesystem::path>& folder) {
    if (folder) file_ = *folder / "recent.json";
  }

  /// Those that are still there.
  std::vector<std::filesystem::path> list() const;
  /// Puts a file first. What cannot be written is not kept.
  void add(const std::filesystem::path& opened) const;

 private:
  std::filesystem::path file_;  // empty: none
};

}  // namespace dismantle::server
