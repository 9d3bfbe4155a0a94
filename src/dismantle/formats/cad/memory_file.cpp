// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/cad/memory_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>

namespace dismantle {

MemoryFile::MemoryFile(std::string_view bytes) : descriptor_(memfd_create("dismantle", MFD_CLOEXEC)) {
  while (descriptor_ >= 0 && !bytes.empty()) {
    const ssize_t count = write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      close(descriptor_);
      descriptor_ = -1;
      return;
    }
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

MemoryFile::~MemoryFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace dismantle
