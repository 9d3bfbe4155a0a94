// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/user_folders.h"

#include <cstdlib>

namespace dismantle {

namespace fs = std::filesystem;

namespace {

/// @param variable of the environment @param otherwise where that is not set, below the home folder
std::optional<fs::path> folder(const char* variable, const char* otherwise) {
  if (const char* base = std::getenv(variable); base != nullptr && fs::path(base).is_absolute())
    return fs::path(base) / "dismantle";
  if (const char* home = std::getenv("HOME"); home != nullptr && fs::path(home).is_absolute())
    return fs::path(home) / otherwise / "dismantle";
  return {};
}

}  // namespace

std::optional<fs::path> user_state_folder() {
  return folder("XDG_STATE_HOME", ".local/state");
}

std::optional<fs::path> user_cache_folder() {
  return folder("XDG_CACHE_HOME", ".cache");
}

}  // namespace dismantle
