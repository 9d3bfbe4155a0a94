// SPDX-License-Identifier: Apache-2.0
#include "dismantle/loading/reader_program.h"

#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>
#include <vector>

namespace dismantle {

namespace fs = std::filesystem;

namespace {

/// The folder of the running program.
fs::path program_folder() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored).parent_path();
}

/// The folder of the program or shared library that this code is in.
fs::path own_folder() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<void*>(&find_reader), &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code ignored;
  return fs::canonical(info.dli_fname, ignored).parent_path();
}

}  // namespace

fs::path find_reader(ReaderProgram program) {
  const char* name = program == ReaderProgram::Cad ? "dismantle-read-cad" : "dismantle-read";
  std::vector<fs::path> folders;
  if (const char* named = std::getenv("DISMANTLE_READERS"); named != nullptr && *named != '\0') folders = {named};
  for (const fs::path& beside : {program_folder(), own_folder()}) {
    if (beside.empty()) continue;
    folders.push_back(beside);
    folders.push_back(beside.parent_path() / "libexec" / "dismantle");
  }
  folders.emplace_back(DISMANTLE_BUILT_READERS);
  folders.emplace_back(DISMANTLE_INSTALLED_READERS);
  for (const fs::path& folder : folders)
    if (access((folder / name).c_str(), X_OK) == 0) return folder / name;
  return {};
}

}  // namespace dismantle
