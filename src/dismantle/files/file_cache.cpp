// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/file_cache.h"

#include "dismantle/files/atomic_file.h"
#include "dismantle/files/read_file.h"
#include "dismantle/files/sha256.h"

#include <algorithm>
#include <chrono>
#include <vector>

namespace dismantle {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kMagic = "dismantle cache 1\n";
constexpr std::string_view kExtension = ".cache";
/// Hexadecimal digits of a checksum.
constexpr std::size_t kDigits = 64;
/// Files that were being written when their process ended are removed after this time.
constexpr auto kAbandoned = std::chrono::hours(24);

std::string checksum(std::string_view key, std::string_view bytes) {
  Sha256 sum;
  sum.update(key);
  sum.update(bytes);
  return sum.finish();
}

}  // namespace

fs::path FileCache::file_of(std::string_view key) const {
  return folder_ / (sha256(key) + std::string(kExtension));
}

std::optional<std::string> FileCache::find(std::string_view key) const {
  const fs::path file = file_of(key);
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return std::nullopt;
  Result<std::string> text = read_file(file, max_bytes_);
  constexpr std::size_t kHead = kMagic.size() + kDigits;
  if (!text || text->size() < kHead || text->compare(0, kMagic.size(), kMagic) != 0) return std::nullopt;
  const std::string_view bytes = std::string_view(*text).substr(kHead);
  if (text->compare(kMagic.size(), kDigits, checksum(key, bytes)) != 0) return std::nullopt;
  fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);  // it was used
  text->erase(0, kHead);
  return std::move(*text);
}

void FileCache::keep(std::string_view key, std::string_view bytes) const {
  const std::uint64_t size = kMagic.size() + kDigits + bytes.size();
  if (size > max_bytes_) return;
  std::error_code error;
  if (fs::create_directories(folder_, error)) fs::permissions(folder_, fs::perms::owner_all, error);
  make_room(size);
  Result<AtomicFile> file = AtomicFile::create(file_of(key));
  if (!file) return;
  file->write(kMagic);
  file->write(checksum(key, bytes));
  file->write(bytes);
  static_cast<void>(file->commit());
}

/// Removes entries until another one of `bytes` fits.
void FileCache::make_room(std::uint64_t bytes) const {
  struct Entry {
    fs::path file;
    fs::file_time_type used;
    std::uint64_t size = 0;
  };
  std::vector<Entry> entries;
  std::error_code error;
  std::uint64_t sum = bytes;
  for (fs::directory_iterator i(folder_, error), end; !error && i != end; i.increment(error)) {
    std::error_code gone;  // by another process
    const Entry entry{i->path(), i->last_write_time(gone), i->file_size(gone)};
    if (gone) continue;
    if (entry.file.extension() == kExtension) {
      entries.push_back(entry);
      sum += entry.size;
    } else if (entry.file.extension() == ".tmp" && fs::file_time_type::clock::now() - entry.used > kAbandoned) {
      fs::remove(entry.file, gone);
    }
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
  for (auto oldest = entries.begin(); sum > max_bytes_ && oldest != entries.end(); ++oldest) {
    std::error_code gone;
    fs::remove(oldest->file, gone);
    sum -= oldest->size;
  }
}

}  // namespace dismantle
