// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// Bytes that a zip archive may have unpacked: this, and kZipExpansion for each byte of the archive. Far above real
/// files, whose text shrinks to a tenth; far below what an archive can be made to claim.
inline constexpr std::size_t kZipUnpackedBase = std::size_t{64} << 20;
/// See kZipUnpackedBase.
inline constexpr std::size_t kZipExpansion = 100;

/// A zip archive in memory, read only. The files in it are found by name; nothing is written to the disk. Errors have
/// the message "<why>; <what to do>".
class ZipArchive {
 public:
  /// The archive of these bytes, which must outlive it. Errors: Unreadable if they are none.
  static Result<ZipArchive> open(std::string_view bytes);
  ///@{ Movable, not copyable.
  ZipArchive(ZipArchive&&) noexcept;
  ZipArchive& operator=(ZipArchive&&) noexcept;
  ~ZipArchive();
  ///@}

  /// The names of all files in it, in the order of the archive.
  std::vector<std::string> names() const;
  /// True if there is a file of that name.
  bool contains(const std::string& name) const;
  /// The unpacked bytes of a file. Errors: Unreadable if there is none of that name, if it is encrypted, damaged, or
  /// packed in a way that is not known, and if more bytes were unpacked in all than the limits above allow.
  Result<std::string> read(const std::string& name);

 private:
  struct Impl;
  explicit ZipArchive(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace dismantle
