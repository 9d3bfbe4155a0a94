// SPDX-License-Identifier: Apache-2.0
#include "tests/faults/folder_contents.h"

#include <cctype>
#include <fstream>
#include <iterator>

namespace dismantle::faults {

namespace fs = std::filesystem;

FolderContents contents_of(const fs::path& folder) {
  FolderContents contents;
  std::error_code error;
  for (fs::recursive_directory_iterator i(folder, error), end; !error && i != end; i.increment(error)) {
    const std::string name = i->path().lexically_relative(folder).generic_string();
    if (i->is_symlink()) {
      contents[name] = "link to " + fs::read_symlink(i->path()).string();
    } else if (i->is_regular_file()) {
      std::ifstream in(i->path(), std::ios::binary);
      contents[name].assign(std::istreambuf_iterator<char>(in), {});
    }
  }
  return contents;
}

void restore(const fs::path& folder, const FolderContents& contents) {
  fs::remove_all(folder);
  fs::create_directories(folder);
  for (const auto& [name, bytes] : contents) {
    fs::create_directories((folder / name).parent_path());
    std::ofstream(folder / name, std::ios::binary) << bytes;
  }
}

std::string without_digits(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (std::isdigit(static_cast<unsigned char>(c)) == 0) {
      text += c;
    } else if (text.empty() || text.back() != 'N') {
      text += 'N';
    }
  }
  return text;
}

}  // namespace dismantle::faults
