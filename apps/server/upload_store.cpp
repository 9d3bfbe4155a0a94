// SPDX-License-Identifier: Apache-2.0
#include "apps/server/upload_store.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace dismantle::server {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kPrefix = "dismantle-uploads-";
constexpr std::size_t kRandomLetters = 6;
/// Attempts to create a folder; one fails if another process that starts takes the folder for one that was left.
constexpr int kMaxTries = 10;

/// A folder that is open and locked by this process. The lock ends with the process, however that ends.
class LockedFolder {
 public:
  /// Opens and locks a folder of this user, never through a symbolic link. None if it is none, or locked elsewhere.
  static std::optional<LockedFolder> lock(const fs::path& path) {
    LockedFolder folder(path, ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    struct stat opened = {}, named = {};
    if (folder.descriptor_ < 0 || ::fstat(folder.descriptor_, &opened) != 0) return {};
    if (opened.st_uid != ::geteuid() || ::flock(folder.descriptor_, LOCK_EX | LOCK_NB) != 0) return {};
    // Whoever held the lock before may have removed the folder.
    const bool is_same =
        ::lstat(path.c_str(), &named) == 0 && named.st_dev == opened.st_dev && named.st_ino == opened.st_ino;
    if (!is_same) return {};
    return folder;
  }
  LockedFolder(LockedFolder&& other) noexcept
      : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}
  LockedFolder& operator=(LockedFolder&&) = delete;
  ~LockedFolder() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  const fs::path& path() const { return path_; }

  /// Removes the folder with everything in it. The entries are reached through the open folder, so that nothing else is
  /// removed if something else has its name by now.
  void remove() const {
    std::error_code ignored;
    const fs::path opened = "/proc/self/fd/" + std::to_string(descriptor_);
    std::vector<fs::path> entries;
    for (fs::directory_iterator at(opened, ignored), end; !ignored && at != end; at.increment(ignored))
      entries.push_back(at->path());
    for (const fs::path& entry : entries) fs::remove_all(entry, ignored);
    ::rmdir(path_.c_str());
  }

 private:
  LockedFolder(fs::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}

  fs::path path_;
  int descriptor_;
};

bool is_store_name(std::string_view name) {
  return name.size() == kPrefix.size() + kRandomLetters && name.substr(0, kPrefix.size()) == kPrefix &&
         std::all_of(name.begin() + kPrefix.size(), name.end(), [](unsigned char c) { return std::isalnum(c); });
}

/// Removes the folders of processes that have ended: nobody holds their lock.
void remove_left_over(const fs::path& temporary) {
  std::error_code error;
  for (fs::directory_iterator at(temporary, error), end; !error && at != end; at.increment(error)) {
    if (!is_store_name(at->path().filename().string())) continue;
    if (const std::optional<LockedFolder> left = LockedFolder::lock(at->path())) left->remove();
  }
}

Result<LockedFolder> new_folder() {
  std::error_code error;
  const fs::path temporary = fs::temp_directory_path(error);
  const std::string pattern = (temporary / (std::string(kPrefix) + std::string(kRandomLetters, 'X'))).string();
  for (int tries = 0; tries < kMaxTries && !error; ++tries) {
    std::string name = pattern;
    if (::mkdtemp(name.data()) == nullptr) break;
    if (std::optional<LockedFolder> folder = LockedFolder::lock(name)) return std::move(*folder);
  }
  return Error{ErrorKind::Failed,
               "no temporary folder can be created (in " + temporary.string() + "); free some space"};
}

/// "1.5 GB"
std::string size_text(std::uint64_t bytes) {
  const std::uint64_t tenths = bytes / 100'000'000;
  return std::to_string(tenths / 10) + '.' + std::to_string(tenths % 10) + " GB";
}

Error refusal(const std::string& why) {
  return {ErrorKind::Failed,
          "the upload is refused (" + why + "); put the files into a folder that the server may read"};
}

}  // namespace

class UploadStore::State : public std::enable_shared_from_this<State> {
 public:
  explicit State(UploadLimits limits) : limits_(limits) {}
  ~State() {
    if (folder_) folder_->remove();
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  Result<std::shared_ptr<UploadFolder>> reserve(const std::string& client, std::uint64_t bytes);
  void end_writing(std::uint64_t bytes) {
    const std::lock_guard lock(mutex_);
    unwritten_ -= bytes;
  }
  void release(const std::string& client, std::uint64_t bytes) {
    const std::lock_guard lock(mutex_);
    total_ -= bytes;
    if ((clients_[client] -= bytes) == 0) clients_.erase(client);
  }

 private:
  Result<Done> check_room(const std::string& client, std::uint64_t bytes) const;

  const UploadLimits limits_;
  std::mutex mutex_;
  std::optional<LockedFolder> folder_;  ///< None until it is needed.
  std::uint64_t folders_ = 0;           ///< Created so far.
  std::map<std::string, std::uint64_t> clients_;
  std::uint64_t total_ = 0, unwritten_ = 0;  ///< Reserved; of that, not known to be on the disk.
};

/// A folder in that of the state.
class UploadStore::ReservedFolder final : public UploadFolder {
 public:
  ReservedFolder(std::shared_ptr<State> state, fs::path path, std::string client, std::uint64_t bytes)
      : state_(std::move(state)), path_(std::move(path)), client_(std::move(client)), bytes_(bytes) {}
  ~ReservedFolder() override {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    set_written();
    state_->release(client_, bytes_);
  }
  const fs::path& path() const override { return path_; }
  void set_written() override {
    if (!std::exchange(is_written_, true)) state_->end_writing(bytes_);
  }

 private:
  std::shared_ptr<State> state_;
  fs::path path_;
  std::string client_;
  std::uint64_t bytes_;
  bool is_written_ = false;
};

Result<Done> UploadStore::State::check_room(const std::string& client, std::uint64_t bytes) const {
  const auto own = clients_.find(client);
  const std::uint64_t used = own == clients_.end() ? 0 : own->second;
  if (bytes > limits_.client_bytes || used > limits_.client_bytes - bytes)
    return refusal("the uploads of this page would take more than " + size_text(limits_.client_bytes));
  if (bytes > limits_.total_bytes || total_ > limits_.total_bytes - bytes)
    return refusal("all uploads together would take more than " + size_text(limits_.total_bytes));
  std::error_code error;
  const fs::space_info disk = fs::space(folder_->path(), error);
  const std::uint64_t wanted = unwritten_ + bytes;
  if (!error && (disk.available < wanted || disk.available - wanted < limits_.min_free_bytes))
    return refusal("the disk has only " + size_text(disk.available) + " left");
  return Done{};
}

Result<std::shared_ptr<UploadFolder>> UploadStore::State::reserve(const std::string& client, std::uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  if (!folder_) {
    Result<LockedFolder> made = new_folder();
    if (!made) return made.error();
    folder_.emplace(std::move(*made));
  }
  if (const Result<Done> room = check_room(client, bytes); !room) return room.error();
  const fs::path path = folder_->path() / std::to_string(++folders_);
  if (::mkdir(path.c_str(), S_IRWXU) != 0)
    return Error{ErrorKind::Failed,
                 "no temporary folder can be created (in " + folder_->path().string() + "); free some space"};
  total_ += bytes;
  unwritten_ += bytes;
  clients_[client] += bytes;
  return std::shared_ptr<UploadFolder>(std::make_shared<ReservedFolder>(shared_from_this(), path, client, bytes));
}

UploadStore::UploadStore(UploadLimits limits) : state_(std::make_shared<State>(limits)) {
  std::error_code error;
  const fs::path temporary = fs::temp_directory_path(error);
  if (!error) remove_left_over(temporary);
}

Result<std::shared_ptr<UploadFolder>> UploadStore::reserve(const std::string& client, std::uint64_t bytes) {
  return state_->reserve(client, bytes);
}

}  // namespace dismantle::server
