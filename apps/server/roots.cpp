// SPDX-License-Identifier: Apache-2.0
#include "apps/server/roots.h"

#include "dismantle/files/text_name.h"
#include "dismantle/formats/import/file_formats.h"

#include <algorithm>
#include <optional>

namespace dismantle::server {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kPathSuffix = ".path.json";

bool ends_with(const std::string& text, std::string_view suffix) {
  return text.size() > suffix.size() && text.compare(text.size() - suffix.size(), suffix.size(), suffix) == 0;
}

bool is_below(const fs::path& folder, const fs::path& file) {
  const auto [end, ignored] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return end == folder.end();
}

Error no_such_file(const std::string& relative) {
  return {ErrorKind::Usage, "'" + clean_name(relative) +
                                "' cannot be opened (the server's folders have no such file); choose one of "
                                "those that it lists"};
}

/// True if a name ends, for the system, before its end.
bool has_nul(const std::string& name) {
  return name.find('\0') != std::string::npos;
}

std::optional<RootEntry> entry_of(const fs::directory_entry& entry) {
  std::error_code error;
  RootEntry found;
  found.name = entry.path().filename().string();
  if (found.name[0] == '.') return {};
  if (entry.is_directory(error)) {
    found.kind = RootEntry::Kind::Folder;
    return found;
  }
  if (!entry.is_regular_file(error)) return {};
  if (ends_with(found.name, kPathSuffix)) {
    found.kind = RootEntry::Kind::Path;
  } else if (format_of(entry.path()) == nullptr) {
    return {};
  }
  found.bytes = entry.file_size(error);
  return found;
}

}  // namespace

Result<Roots> Roots::create(const std::vector<fs::path>& folders) {
  Roots roots;
  for (const fs::path& folder : folders) {
    std::error_code error;
    fs::path real = fs::canonical(folder, error);
    if (error || !fs::is_directory(real, error))
      return Error{ErrorKind::Usage,
                   folder.string() + " cannot be a root (it is not a readable folder); give an existing folder"};
    roots.names_.push_back(real.filename().empty() ? real.string() : real.filename().string());
    roots.folders_.push_back(std::move(real));
  }
  return roots;
}

Result<fs::path> Roots::find(std::uint64_t root, const std::string& relative) const {
  if (root >= folders_.size() || fs::path(relative).is_absolute() || has_nul(relative)) return no_such_file(relative);
  std::error_code error;
  fs::path real = fs::canonical(folders_[root] / relative, error);
  if (error || !is_below(folders_[root], real)) return no_such_file(relative);
  return real;
}

Result<fs::path> Roots::output_path(std::uint64_t root, const std::string& relative) const {
  const fs::path requested(relative);
  const Result<fs::path> folder = find(root, requested.parent_path().string());
  const std::string name = requested.filename().string();
  if (!folder || name.empty() || name == "." || name == ".." || has_nul(name))
    return Error{ErrorKind::Usage, "'" + clean_name(relative) +
                                       "' cannot be written (the server's folders have no such path); choose "
                                       "one of those that it lists"};
  std::error_code error;
  const fs::file_status status = fs::symlink_status(*folder / name, error);
  if (fs::exists(status) && !fs::is_regular_file(status))
    return Error{ErrorKind::Usage,
                 "'" + relative + "' cannot be written (the name is not that of a file); choose another"};
  return *folder / name;
}

Result<std::vector<RootEntry>> Roots::list(std::uint64_t root, const std::string& folder) const {
  const Result<fs::path> real = find(root, folder);
  if (!real) return real.error();
  std::error_code error;
  std::vector<RootEntry> entries;
  for (fs::directory_iterator at(*real, error), end; !error && at != end; at.increment(error)) {
    std::error_code broken;
    const fs::path target = fs::canonical(at->path(), broken);
    if (broken || !is_below(folders_[root], target)) continue;
    if (std::optional<RootEntry> entry = entry_of(*at)) entries.push_back(std::move(*entry));
  }
  if (error) return no_such_file(folder);
  std::sort(entries.begin(), entries.end(), [](const RootEntry& a, const RootEntry& b) {
    const bool a_folder = a.kind == RootEntry::Kind::Folder, b_folder = b.kind == RootEntry::Kind::Folder;
    return a_folder != b_folder ? a_folder : a.name < b.name;
  });
  return entries;
}

bool Roots::contains(const fs::path& file) const {
  std::error_code error;
  const fs::path real = fs::canonical(file, error);
  if (error) return false;
  return std::any_of(folders_.begin(), folders_.end(), [&](const fs::path& folder) { return is_below(folder, real); });
}

}  // namespace dismantle::server
