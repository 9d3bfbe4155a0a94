// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace dismantle {

/// Results that are expensive to compute, kept in a folder of files between runs. Processes may share the folder:
/// entries appear whole or not at all. An entry that was truncated or changed is taken for missing, and nothing here
/// is an error: where an entry cannot be read or written, it is computed again.
class FileCache {
 public:
  /// @param folder is made when the first entry is kept, readable by its owner only
  /// @param max_bytes of all entries together; those that were not used for the longest time are removed
  FileCache(std::filesystem::path folder, std::uint64_t max_bytes)
      : folder_(std::move(folder)), max_bytes_(max_bytes) {}

  /// The bytes that were kept for a key.
  std::optional<std::string> find(std::string_view key) const;
  /// Keeps bytes for a key. @param key all that the bytes depend on, the version of the program included
  void keep(std::string_view key, std::string_view bytes) const;

 private:
  std::filesystem::path file_of(std::string_view key) const;
  void make_room(std::uint64_t bytes) const;

  std::filesystem::path folder_;
  std::uint64_t max_bytes_;
};

}  // namespace dismantle
