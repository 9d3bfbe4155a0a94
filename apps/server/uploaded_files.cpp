// SPDX-License-Identifier: Apache-2.0
#include "apps/server/uploaded_files.h"

#include "dismantle/formats/import/file_formats.h"

#include "apps/server/session_json.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace dismantle::server {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxFiles = 20'000;  // with their folders
constexpr std::size_t kMaxLine = 4096;
constexpr std::size_t kBufferBytes = std::size_t{1} << 16;

Error malformed(const std::string& why) {
  return {ErrorKind::Usage, "the files were not understood (" + why + "); see docs/wire.md"};
}

/// A file of the body: a line of JSON, then its bytes.
struct PackedFile {
  fs::path path;
  std::uint64_t bytes = 0;
  std::streamoff start = 0;  ///< Of the bytes.
};

/// True if a relative path stays in its folder and has no hidden parts.
bool is_inside(const fs::path& path) {
  if (path.empty() || path.is_absolute()) return false;
  return std::none_of(path.begin(), path.end(), [](const fs::path& part) {
    const std::string name = part.string();
    return name.empty() || name[0] == '.' || name.find_first_of(std::string("\\\0", 2)) != std::string::npos;
  });
}

Result<PackedFile> parse_line(const std::string& line) {
  const Json json = Json::parse(line, nullptr, false);
  if (!json.is_object() || !json.contains("path") || !json["path"].is_string() || !json.contains("bytes") ||
      !json["bytes"].is_number_unsigned())
    return malformed("a file has no line with its path and size");
  PackedFile file{fs::path(json["path"].get<std::string>()), json["bytes"].get<std::uint64_t>(), 0};
  if (!is_inside(file.path)) return malformed("a path leaves the folder");
  return file;
}

Result<Done> copy_bytes(std::istream& in, const fs::path& to, std::uint64_t bytes) {
  std::error_code error;
  fs::create_directories(to.parent_path(), error);
  std::ofstream out(to, std::ios::binary);
  std::string buffer(kBufferBytes, '\0');
  for (std::uint64_t left = bytes; left > 0 && in && out;) {
    const auto part = static_cast<std::streamsize>(std::min<std::uint64_t>(left, buffer.size()));
    if (!in.read(buffer.data(), part)) return malformed("a file is shorter than its line says");
    out.write(buffer.data(), part);
    left -= static_cast<std::uint64_t>(part);
  }
  out.close();
  if (!out)
    return Error{ErrorKind::Failed,
                 "'" + to.filename().string() + "' cannot be stored (writing failed); free some space"};
  return Done{};
}

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (std::error_code broken; at->is_regular_file(broken)) files.push_back(at->path());
  std::sort(files.begin(), files.end());
  return files;
}

Error several(const std::string& what) {
  return {ErrorKind::Usage, "it is not clear what to open (there are " + what + "); open one of them"};
}

/// The files and folders that a body makes.
class UnpackedEntries {
 public:
  /// Counts a file and those of its folders that are new. @return false if these are too many
  bool add(const fs::path& file) {
    ++files_;
    for (fs::path folder = file.parent_path(); !folder.empty() && files_ + folders_.size() <= kMaxFiles;
         folder = folder.parent_path())
      if (!folders_.insert(folder).second) break;
    return files_ + folders_.size() <= kMaxFiles;
  }

 private:
  std::size_t files_ = 0;
  std::set<fs::path> folders_;
};

/// The files of a body, all of which is looked through before anything is written.
Result<std::vector<PackedFile>> list_files(std::istream& in, std::uint64_t size) {
  std::vector<PackedFile> files;
  UnpackedEntries entries;
  for (std::string line; std::getline(in, line);) {
    if (line.size() > kMaxLine) return malformed("a line is too long");
    Result<PackedFile> file = parse_line(line);
    if (!file) return file.error();
    if (!entries.add(file->path)) return malformed("there are too many files and folders");
    file->start = in.tellg();
    if (file->start < 0 || file->bytes > size - static_cast<std::uint64_t>(file->start))
      return malformed("a file is shorter than its line says");
    in.seekg(static_cast<std::streamoff>(file->bytes), std::ios::cur);
    files.push_back(std::move(*file));
  }
  if (files.empty()) return malformed("there are none");
  return files;
}

}  // namespace

Result<Done> unpack_files(const fs::path& body, const fs::path& folder) {
  std::ifstream in(body, std::ios::binary);
  const Result<std::vector<PackedFile>> files = list_files(in, fs::file_size(body));
  if (!files) return files.error();
  std::error_code error;
  fs::create_directories(folder, error);
  in.clear();
  for (const PackedFile& file : *files) {
    in.seekg(file.start);
    if (const Result<Done> copied = copy_bytes(in, folder / file.path, file.bytes); !copied) return copied.error();
  }
  return Done{};
}

Result<fs::path> assembly_among(const fs::path& folder) {
  std::vector<fs::path> assemblies, parts;
  std::set<fs::path> part_folders;
  for (const fs::path& file : files_below(folder)) {
    const FormatEntry* format = format_of(file);
    if (format == nullptr) continue;
    // The COLLADA files of a URDF are its meshes.
    (format->is_part || format->format == FileFormat::Collada ? parts : assemblies).push_back(file);
    if (format->is_part) part_folders.insert(file.parent_path());
  }
  if (assemblies.size() == 1) return assemblies[0];
  if (assemblies.size() > 1)
    return several("several assemblies, such as " + assemblies[0].filename().string() + " and " +
                   assemblies[1].filename().string());
  if (parts.size() == 1) return parts[0];
  if (part_folders.size() > 1) return several("meshes in several folders");
  if (part_folders.size() == 1) return *part_folders.begin();
  if (parts.size() > 1) return several("several COLLADA files");
  return Error{ErrorKind::Usage, "there is nothing to open (no file has a known format); open " + format_names()};
}

}  // namespace dismantle::server
