// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/faults/kill_table.h"

#include <filesystem>
#include <string>
#include <vector>

namespace dismantle::faults {

/// The kinds of work during which the program is killed: import, plan, export, batch, drag, search.
const std::vector<std::string>& kill_kinds();

/// Kills the program `kills` times while it does work of a kind. Throws std::runtime_error if there is no such kind, or
/// the work fails undisturbed.
/// @param folder for its files, which are removed
KillRow kill_at_random(const std::string& kind, int kills, std::uint64_t seed, const std::filesystem::path& folder);

}  // namespace dismantle::faults
