// SPDX-License-Identifier: Apache-2.0
#include "apps/batch/batch_items.h"

#include "dismantle/files/sha256.h"
#include "dismantle/formats/import/file_formats.h"

#include <fnmatch.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <set>

namespace dismantle::batch {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxFolderName = 200;

/// The properties of a file that its key covers.
struct FileState {
  std::uint64_t bytes = 0;
  std::int64_t changed = 0;  ///< Modification time in ticks of the clock.
};

/// All files below the root, by name.
using FileTree = std::map<std::string, FileState>;

/// "a/b/c.step" -> "a/b/"; "c.step" -> "".
std::string parent_of(const std::string& name) {
  return name.substr(0, name.rfind('/') + 1);
}

Result<FileTree> walk(const fs::path& root, const fs::path& except) {
  FileTree files;
  std::error_code error;
  fs::recursive_directory_iterator entry(root, fs::directory_options::skip_permission_denied, error);
  if (error)
    return Error{ErrorKind::Unreadable,
                 root.string() + " cannot be read (" + error.message() + "); give a folder that holds assemblies"};
  for (const fs::recursive_directory_iterator end; entry != end && !error; entry.increment(error)) {
    std::error_code ignored;
    const bool hidden = entry->path().filename().string().front() == '.';
    if (entry->is_directory(ignored)) {
      if (hidden || fs::equivalent(entry->path(), except, ignored)) entry.disable_recursion_pending();
      continue;
    }
    if (hidden || !entry->is_regular_file(ignored)) continue;
    const FileState state{entry->file_size(ignored), entry->last_write_time(ignored).time_since_epoch().count()};
    files[entry->path().lexically_relative(root).generic_string()] = state;
  }
  if (error)
    return Error{ErrorKind::Unreadable,
                 root.string() + " cannot be read to its end (" + error.message() + "); check its permissions"};
  return files;
}

/// The files whose names begin with `prefix`.
std::pair<FileTree::const_iterator, FileTree::const_iterator> below(const FileTree& files, const std::string& prefix) {
  const auto first = files.lower_bound(prefix);
  auto last = first;
  while (last != files.end() && last->first.compare(0, prefix.size(), prefix) == 0) ++last;
  return {first, last};
}

/// The files of each assembly, by the assembly's name.
std::map<std::string, std::vector<std::string>> group(const FileTree& files, MeshGrouping meshes) {
  std::map<std::string, std::vector<std::string>> items, folders;
  for (const auto& [name, state] : files) {
    const FormatEntry* entry = format_of(name);
    if (entry == nullptr) continue;
    if (entry->is_part) {
      folders[parent_of(name)].push_back(name);
    } else {
      items[name] = {name};
    }
  }
  for (auto& [folder, members] : folders) {
    if (meshes == MeshGrouping::Folder && members.size() > 1) {
      items[folder.empty() ? "." : folder.substr(0, folder.size() - 1)] = members;
    } else {
      for (const std::string& member : members) items[member] = {member};
    }
  }
  return items;
}

void add_to_key(Sha256& hash, const std::string& name, const FileState& state) {
  hash.update(name + '\0' + std::to_string(state.bytes) + ' ' + std::to_string(state.changed) + '\n');
}

std::string key_of(const std::string& item, const std::vector<std::string>& own, const FileTree& files,
                   const std::string& options) {
  Sha256 hash;
  hash.update(options + '\0' + item + '\0');
  for (const std::string& name : own) add_to_key(hash, name, files.at(name));
  const FormatEntry* entry = format_of(item);
  if (entry == nullptr || entry->is_part || !entry->has_links) return hash.finish();
  const bool reaches_out = entry->format == FileFormat::Urdf;  // to packages beside its folder
  const std::string prefix = reaches_out ? item.substr(0, item.find('/') + 1) : parent_of(item);
  const auto [first, last] = below(files, prefix);
  for (auto file = first; file != last; ++file) add_to_key(hash, file->first, file->second);
  return hash.finish();
}

/// The name of the result folder: "a/b.step" -> "a__b.step".
std::string folder_name(const std::string& item) {
  if (item == ".") return "all";
  std::string name;
  for (const char c : item) name += c == '/' ? std::string("__") : std::string(1, c);
  if (name.size() <= kMaxFolderName) return name;
  return name.substr(0, kMaxFolderName) + "~" + sha256(item).substr(0, 16);
}

}  // namespace

Result<std::vector<BatchItem>> find_batch_items(const fs::path& root, const BatchSelection& selection,
                                                const std::string& options) {
  const Result<FileTree> files = walk(root, selection.except);
  if (!files) return files.error();
  std::vector<BatchItem> items;
  std::set<std::string> taken;
  for (const auto& [name, own] : group(*files, selection.meshes)) {
    if (!selection.only.empty() && fnmatch(selection.only.c_str(), name.c_str(), 0) != 0) continue;
    std::string folder = folder_name(name);
    for (int repeat = 2; !taken.insert(folder).second; ++repeat)
      folder = folder_name(name) + "#" + std::to_string(repeat);
    BatchItem item{name, name == "." ? root : root / name, folder, key_of(name, own, *files, options), 0};
    for (const std::string& file : own) item.bytes += files->at(file).bytes;
    items.push_back(std::move(item));
  }
  if (items.empty())
    return Error{ErrorKind::Unreadable, root.string() + " contains no assembly (no " + format_names() + " file" +
                                            (selection.only.empty() ? "" : " of a name like '" + selection.only + "'") +
                                            "); give another folder"};
  return items;
}

}  // namespace dismantle::batch
