// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dismantle::server {

/// The entries of a folder that a client may see.
struct RootEntry {
  enum class Kind { Folder, Assembly, Path };
  std::string name;
  Kind kind = Kind::Assembly;
  std::uint64_t bytes = 0;
};

/// The folders whose files clients may open. Nothing outside them can be reached: not by "..", not by an absolute path,
/// not by a symbolic link that leads out.
class Roots {
 public:
  /// Errors: Usage where one is no folder.
  static Result<Roots> create(const std::vector<std::filesystem::path>& folders);

  /// Their names for clients, by index.
  const std::vector<std::string>& names() const { return names_; }
  /// The file or folder `relative` of a root, links resolved. Errors: Usage where there is none, or it is outside.
  Result<std::filesystem::path> find(std::uint64_t root, const std::string& relative) const;
  /// Where a file `relative` of a root may be written; it need not exist. Errors: Usage where its folder is missing or
  /// outside, or something other than a regular file has its name.
  Result<std::filesystem::path> place_for(std::uint64_t root, const std::string& relative) const;
  /// Folders first, then files that dismantle reads, by name; hidden ones are left out. Errors: as find().
  Result<std::vector<RootEntry>> list(std::uint64_t root, const std::string& folder) const;
  /// True if a file is below one of them, with links resolved.
  bool contain(const std::filesystem::path& file) const;

 private:
  std::vector<std::filesystem::path> folders_;  // canonical
  std::vector<std::string> names_;
};

}  // namespace dismantle::server
