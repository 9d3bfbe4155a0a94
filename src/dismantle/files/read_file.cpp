// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/read_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string_view>

namespace dismantle {

namespace {

Error unreadable(const std::filesystem::path& file, std::string_view why, std::string_view advice) {
  return {ErrorKind::Unreadable, file.string() + " cannot be read (" + std::string(why) + "); " + std::string(advice)};
}

/// Closes a file descriptor at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace

Result<std::string> read_file(const std::filesystem::path& file, std::size_t limit_bytes) {
  // Non-blocking: opening a pipe without a writer must not hang before it is refused.
  const Descriptor in(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (in.get() < 0) return unreadable(file, std::strerror(errno), "check the path and its permissions");
  struct stat status {};
  if (::fstat(in.get(), &status) != 0) return unreadable(file, std::strerror(errno), "check the path");
  if (S_ISDIR(status.st_mode)) return unreadable(file, "it is a folder", "give a file");
  if (!S_ISREG(status.st_mode)) return unreadable(file, "it is not a regular file", "give a file on a disk");
  if (status.st_size == 0) return unreadable(file, "it is empty", "export it again");
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > limit_bytes)
    return unreadable(file, std::to_string(size) + " bytes, more than the limit of " + std::to_string(limit_bytes),
                      "split or simplify it");

  std::string bytes(size, '\0');
  std::size_t done = 0;
  while (done < size) {
    const ssize_t n = ::read(in.get(), bytes.data() + done, size - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return unreadable(file, std::strerror(errno), "check the disk");
    if (n == 0) return unreadable(file, "it shrank while it was read", "try again");
    done += static_cast<std::size_t>(n);
  }
  return bytes;
}

}  // namespace dismantle
