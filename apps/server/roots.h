// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dismantle::server {

/// An entry of a folder that clients may list.
struct RootEntry {
  /// The kinds of entries; other files are not listed.
  enum class Kind { Folder, Assembly, Path };
  std::string name;            ///< Without its folder.
  Kind kind = Kind::Assembly;  ///< By the extension.
  std::uint64_t bytes = 0;     ///< Size of the file; 0 for a folder.
};

/// The folders whose files clients may open. Files outside them cannot be reached: not by "..", by an absolute path, or
/// by a symbolic link that leads out. Unchanging, so usable on any thread.
class Roots {
 public:
  /// The roots of these folders. Errors: Usage if one is not a readable folder.
  static Result<Roots> create(const std::vector<std::filesystem::path>& folders);

  /// The folders, with links resolved.
  const std::vector<std::filesystem::path>& folders() const { return folders_; }
  /// The names of the roots for clients, by index.
  const std::vector<std::string>& names() const { return names_; }
  /// The file or folder `relative` in a root, with links resolved. Errors: Usage if there is none, or it is outside.
  Result<std::filesystem::path> find(std::uint64_t root, const std::string& relative) const;
  /// The path at which a file `relative` in a root may be written; it need not exist. Errors: Usage if its folder is
  /// missing or outside, or something other than a regular file has its name.
  Result<std::filesystem::path> output_path(std::uint64_t root, const std::string& relative) const;
  /// The entries of a folder: folders first, then the files that dismantle reads, by name; without hidden ones. Errors:
  /// as find().
  Result<std::vector<RootEntry>> list(std::uint64_t root, const std::string& folder) const;
  /// True if a file is below one of the roots, with links resolved.
  bool contains(const std::filesystem::path& file) const;

 private:
  std::vector<std::filesystem::path> folders_;  // canonical
  std::vector<std::string> names_;
};

}  // namespace dismantle::server
