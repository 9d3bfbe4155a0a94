// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/import/referenced_file.h"

#include "dismantle/files/text_name.h"
#include "dismantle/formats/import/file_formats.h"

#include <algorithm>
#include <string>

namespace dismantle {

namespace fs = std::filesystem;

namespace {

/// The same folder without links and dots; as it is where it does not exist.
fs::path resolved(const fs::path& folder) {
  std::error_code error;
  fs::path whole = fs::canonical(folder.empty() ? fs::path(".") : folder, error);
  return error ? folder : whole;
}

/// The nearest folder at or above `folder` that has a package.xml, or else `folder`.
fs::path package_of(const fs::path& folder) {
  std::error_code ignored;
  for (fs::path above = folder; above.has_relative_path(); above = above.parent_path())
    if (fs::is_regular_file(above / "package.xml", ignored)) return above;
  return folder;
}

bool is_inside(const fs::path& file, const fs::path& folder) {
  const auto ends = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return ends.first == folder.end() && ends.second != file.end();
}

}  // namespace

std::vector<fs::path> reference_folders(const fs::path& model, const ImportOptions& options) {
  const FormatEntry* entry = format_of(model);
  if (entry == nullptr || !entry->has_links) return {};
  const fs::path own = resolved(model.parent_path());
  std::vector<fs::path> folders = {entry->format == FileFormat::Urdf ? package_of(own) : own};
  for (const fs::path& folder : options.reference_folders) folders.push_back(resolved(folder));
  return folders;
}

Result<fs::path> referenced_file(const fs::path& address, const fs::path& base, const std::vector<fs::path>& folders) {
  const auto refused = [](const std::string& why_and_advice) { return Error{ErrorKind::Unreadable, why_and_advice}; };
  if (address.native().find('\0') != std::string::npos) return refused("is no file name; export it again");
  const fs::path file = (resolved(base) / address).lexically_normal();
  const auto folder =
      std::find_if(folders.begin(), folders.end(), [&](const fs::path& place) { return is_inside(file, place); });
  if (folder == folders.end())
    return refused("is not in its folder; keep both in one folder, or name the other one with --references");
  std::error_code error;
  fs::path step = *folder;
  for (const fs::path& name : file.lexically_relative(*folder)) {
    step /= name;
    if (fs::is_symlink(fs::symlink_status(step, error)))
      return refused("is reached through a symbolic link; put a copy in the place of " + in_quotes(name.string()));
  }
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) return refused("is not there; keep both in one folder");
  if (!fs::is_regular_file(status)) return refused("is no file; export it again");
  return file;
}

}  // namespace dismantle
