// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

namespace dismantle {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 20;
constexpr int kNameAttempts = 1000;

fs::path temporary_name(const fs::path& folder) {
  static std::atomic<unsigned> counter{0};
  return folder / (".dismantle-" + std::to_string(::getpid()) + "-" + std::to_string(counter++) + ".tmp");
}

/// The name by which a file without a name can be linked.
std::string link_source(int descriptor) {
  return "/proc/self/fd/" + std::to_string(descriptor);
}

/// Opens a new file in `folder`, without a name if the system can give it one later, else under a unique name; its mode
/// follows the umask.
std::pair<int, fs::path> open_temporary(const fs::path& folder) {
  const int unnamed = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  if (unnamed >= 0 && ::access(link_source(unnamed).c_str(), F_OK) == 0) return {unnamed, {}};
  if (unnamed >= 0) ::close(unnamed);
  for (int attempt = 0; attempt < kNameAttempts; ++attempt) {
    fs::path name = temporary_name(folder);
    const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0 || errno != EEXIST) return {descriptor, std::move(name)};
  }
  return {-1, {}};
}

/// Gives a file without a name one that is free. @return false with errno if that is impossible
bool link_to(int descriptor, const fs::path& name) {
  return ::linkat(AT_FDCWD, link_source(descriptor).c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

void sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

}  // namespace

Error AtomicFile::failure(std::string_view what) const {
  return {ErrorKind::Failed, target_.string() + " cannot be written (" + std::string(what) +
                                 "); check the folder, its permissions and the free space"};
}

Result<AtomicFile> AtomicFile::create(const fs::path& file) {
  AtomicFile result;
  std::error_code ignored;
  result.target_ = fs::is_symlink(file, ignored) ? fs::weakly_canonical(file, ignored) : file;
  if (result.target_.empty()) result.target_ = file;

  const fs::file_status status = fs::status(result.target_, ignored);
  if (fs::is_directory(status)) return result.failure("it is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    result.is_direct_ = true;
    result.descriptor_ = ::open(result.target_.c_str(), O_WRONLY | O_CLOEXEC);
  } else {
    std::tie(result.descriptor_, result.temporary_) = open_temporary(folder_of(result.target_));
    if (fs::exists(status) && result.descriptor_ >= 0)
      ::fchmod(result.descriptor_, static_cast<mode_t>(status.permissions()));
  }
  if (result.descriptor_ < 0) {
    result.temporary_.clear();
    return result.failure(std::strerror(errno));
  }
  return result;
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept {
  *this = std::move(other);
}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  std::swap(target_, other.target_);
  std::swap(temporary_, other.temporary_);
  std::swap(is_direct_, other.is_direct_);
  std::swap(buffer_, other.buffer_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(error_number_, other.error_number_);
  return *this;
}

AtomicFile::~AtomicFile() {
  discard();
}

void AtomicFile::discard() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  temporary_.clear();
}

void AtomicFile::write(std::string_view bytes) {
  DISMANTLE_EXPECT(descriptor_ >= 0);
  buffer_.append(bytes);
  if (buffer_.size() >= kBufferBytes) flush();
}

void AtomicFile::flush() {
  std::size_t written = 0;
  while (error_number_ == 0 && written < buffer_.size()) {
    const ssize_t n = ::write(descriptor_, buffer_.data() + written, buffer_.size() - written);
    if (n > 0) {
      written += static_cast<std::size_t>(n);
    } else if (n == 0 || errno != EINTR) {
      error_number_ = n == 0 ? EIO : errno;
    }
  }
  buffer_.clear();
}

/// Puts the temporary file in the place of the target. @return 0, or the error number
int AtomicFile::publish() {
  if (::fsync(descriptor_) != 0) return errno;
  if (temporary_.empty()) {
    if (link_to(descriptor_, target_)) return 0;
    if (errno != EEXIST) return errno;
    for (int attempt = 0; attempt < kNameAttempts && temporary_.empty(); ++attempt) {
      const fs::path name = temporary_name(folder_of(target_));
      if (link_to(descriptor_, name)) {
        temporary_ = name;
      } else if (errno != EEXIST) {
        return errno;
      }
    }
  }
  if (temporary_.empty()) return EEXIST;
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) return errno;
  temporary_.clear();
  return 0;
}

Result<Done> AtomicFile::commit() {
  DISMANTLE_EXPECT(descriptor_ >= 0);
  flush();
  if (error_number_ == 0 && !is_direct_) error_number_ = publish();
  const bool is_closed = ::close(std::exchange(descriptor_, -1)) == 0;
  if (!is_closed && is_direct_ && error_number_ == 0) error_number_ = errno;
  if (error_number_ != 0) {
    discard();
    return failure(std::strerror(error_number_));
  }
  if (!is_direct_) sync_folder(folder_of(target_));
  return Done{};
}

Result<Done> write_file(const fs::path& file, std::string_view bytes) {
  Result<AtomicFile> out = AtomicFile::create(file);
  if (!out) return out.error();
  out->write(bytes);
  return out->commit();
}

}  // namespace dismantle
