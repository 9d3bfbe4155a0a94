// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/cad/freecad_archives.h"

#include "dismantle/files/read_file.h"
#include "dismantle/files/sha256.h"
#include "dismantle/formats/import/referenced_file.h"

#include <string_view>
#include <utility>

namespace dismantle {

namespace fs = std::filesystem;

FreeCadArchives::FreeCadArchives(const CadSource& source, const ImportOptions& options)
    : source_(source),
      root_(fs::absolute(source.file).lexically_normal()),
      file_limit_(options.limits.file_bytes),
      folders_(reference_folders(source.file, options)) {}

Result<std::string> FreeCadArchives::read(const fs::path& file, const std::string& entry) {
  const auto [place, is_new] = open_.try_emplace(file);
  if (is_new)
    if (const Result<Done> opened = open(file, place->second); !opened) {
      open_.erase(place);
      return opened.error();
    }
  return place->second.archive->read(entry);
}

std::vector<LinkedFile> FreeCadArchives::linked_files() const {
  std::vector<LinkedFile> files;
  for (const auto& [file, open] : open_)
    if (file != root_) files.push_back({file, sha256(open.bytes)});
  return files;
}

Result<Done> FreeCadArchives::open(const fs::path& file, Open& open) {
  if (file != root_) {
    const fs::path folder = root_.parent_path(), relative = file.lexically_relative(folder);
    const Result<fs::path> linked = referenced_file(relative, folder, folders_);
    if (!linked) return Error{ErrorKind::Unreadable, "it " + linked.error().message};
    Result<std::string> bytes = read_file(*linked, file_limit_);
    if (!bytes) {  // "<file> cannot be read (<why>); <what to do>"
      const std::string& message = bytes.error().message;
      const std::size_t why = message.find(" cannot be read (") + 17, end = message.rfind("); ");
      return Error{ErrorKind::Unreadable, message.substr(why, end - why) + "; " + message.substr(end + 3)};
    }
    open.bytes = std::move(*bytes);
  }
  Result<ZipArchive> archive = ZipArchive::open(file == root_ ? source_.bytes : std::string_view(open.bytes));
  if (!archive) return archive.error();
  open.archive = std::move(*archive);
  return Done{};
}

}  // namespace dismantle
