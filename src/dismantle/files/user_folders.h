// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

namespace dismantle {

/// The program's folder for state that outlives it (XDG base directories); nothing if the environment does not give
/// one.
std::optional<std::filesystem::path> user_state_folder();
/// The same for what can be computed again.
std::optional<std::filesystem::path> user_cache_folder();

}  // namespace dismantle
