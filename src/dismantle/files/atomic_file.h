// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace dismantle {

/// A file that appears under its name whole or not at all: it is written to a temporary file in the same folder,
/// flushed to the disk and renamed by commit(). Without commit() the temporary file is removed and the file that had
/// the name before is unchanged. Where the file system can do it, the temporary file has no name until commit(), so
/// that a process that is killed leaves none. A target that is not a regular file (a pipe, /dev/stdout) is written to
/// directly, never replaced.
class AtomicFile {
 public:
  /// Opens the temporary file beside `file`. Errors: Failed where the folder is missing or not writable, or `file` is a
  /// folder.
  static Result<AtomicFile> create(const std::filesystem::path& file);

  /// Takes over the open file; `other` must not be used afterwards.
  AtomicFile(AtomicFile&& other) noexcept;
  /// Discards the file that is open here and takes over that of `other`.
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  ~AtomicFile();

  /// Appends bytes. The first error (disk full) is remembered and returned by commit().
  void write(std::string_view bytes);

  /// Finishes the file under its name. Errors: Failed where anything could not be written; then nothing has changed.
  /// Nothing may be written afterwards.
  Result<Done> commit();

 private:
  AtomicFile() = default;
  void flush();
  int publish();
  void discard();
  Error failure(std::string_view what) const;

  std::filesystem::path target_;
  std::filesystem::path temporary_;  // empty where it has no name, or the target is written to directly
  std::string buffer_;
  bool is_direct_ = false;
  int descriptor_ = -1;
  int error_number_ = 0;  // of the first write that failed
};

/// Writes `bytes` to `file`, whole or not at all (see AtomicFile). Errors: Failed.
Result<Done> write_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace dismantle
