// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace dismantle::server {

/// The recently opened assemblies, newest first, stored in a file. Errors of that file are ignored. Not thread-safe
/// between processes: the last writer wins.
class RecentFiles {
 public:
  /// Without a folder the list is always empty.
  explicit RecentFiles(const std::optional<std::filesystem::path>& folder) {
    if (folder) file_ = *folder / "recent.json";
  }

  /// Those that still exist, newest first.
  std::vector<std::filesystem::path> list() const;
  /// Puts a file first; the oldest ones are dropped.
  void add(const std::filesystem::path& opened) const;

 private:
  std::filesystem::path file_;  // empty: none
};

}  // namespace dismantle::server
