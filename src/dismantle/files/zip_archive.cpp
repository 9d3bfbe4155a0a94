// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/zip_archive.h"

#include "dismantle/files/text_name.h"

#include <zip.h>

#include <algorithm>
#include <utility>

namespace dismantle {

namespace {

constexpr std::size_t kPiece = std::size_t{1} << 20;  // bytes unpacked at a time

Error unreadable(std::string problem) {
  return {ErrorKind::Unreadable, std::move(problem)};
}

}  // namespace

struct ZipArchive::Impl {
  zip_t* archive = nullptr;
  std::size_t bytes_left = 0;  // that may be unpacked

  ~Impl() {
    if (archive != nullptr) zip_discard(archive);
  }
};

ZipArchive::ZipArchive(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ZipArchive::ZipArchive(ZipArchive&&) noexcept = default;
ZipArchive& ZipArchive::operator=(ZipArchive&&) noexcept = default;
ZipArchive::~ZipArchive() = default;

Result<ZipArchive> ZipArchive::open(std::string_view bytes) {
  auto impl = std::make_unique<Impl>();
  impl->bytes_left = kZipUnpackedBase + kZipExpansion * bytes.size();
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  if (source != nullptr) impl->archive = zip_open_from_source(source, ZIP_RDONLY, &error);
  if (source != nullptr && impl->archive == nullptr) zip_source_free(source);
  zip_error_fini(&error);
  if (impl->archive == nullptr || bytes.empty())
    return unreadable("it is no zip archive, or was cut off; get the whole file");
  return ZipArchive(std::move(impl));
}

std::vector<std::string> ZipArchive::names() const {
  std::vector<std::string> names;
  const zip_int64_t count = zip_get_num_entries(impl_->archive, 0);
  for (zip_int64_t i = 0; i < count; ++i)
    if (const char* name = zip_get_name(impl_->archive, static_cast<zip_uint64_t>(i), 0)) names.emplace_back(name);
  return names;
}

bool ZipArchive::contains(const std::string& name) const {
  return zip_name_locate(impl_->archive, name.c_str(), 0) >= 0;
}

Result<std::string> ZipArchive::read(const std::string& name) {
  const zip_int64_t index = zip_name_locate(impl_->archive, name.c_str(), 0);
  if (index < 0) return unreadable(in_quotes(name) + " is missing in it; export it again");
  zip_file_t* file = zip_fopen_index(impl_->archive, static_cast<zip_uint64_t>(index), 0);
  if (file == nullptr)
    return unreadable(in_quotes(name) + " in it is encrypted, or packed in an unknown way; save it without");
  std::string bytes;
  zip_int64_t count = 0;
  do {
    const std::size_t old_size = bytes.size();
    const std::size_t piece = std::min(kPiece, impl_->bytes_left + 1);  // one more shows that there is more
    bytes.resize(old_size + piece);
    count = zip_fread(file, bytes.data() + old_size, piece);
    const std::size_t unpacked = count > 0 ? static_cast<std::size_t>(count) : 0;
    bytes.resize(old_size + unpacked);
    if (unpacked > impl_->bytes_left) {
      zip_fclose(file);
      return unreadable("it unpacks to more than a hundred times its size; check where it comes from");
    }
    impl_->bytes_left -= unpacked;
  } while (count > 0);
  const bool damaged = zip_fclose(file) != 0 || count < 0;
  if (damaged) return unreadable(in_quotes(name) + " in it is damaged; get the file again");
  return bytes;
}

}  // namespace dismantle
