// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace dismantle {

/// A file of these bytes in memory, for libraries that read only files. It ends with this object.
class MemoryFile {
 public:
  /// Copies the bytes.
  explicit MemoryFile(std::string_view bytes);
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile();

  /// True if there was memory for it.
  explicit operator bool() const { return descriptor_ >= 0; }
  /// A path at which this process can open it.
  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_ = -1;
};

}  // namespace dismantle
