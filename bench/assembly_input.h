// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly_file.h"

#include <filesystem>

namespace dismantle {

/// An assembly for a benchmark, with its motion where there is one: of a `.dasm` file, or of a file in any other format
/// and the `*.motion.json` beside it. Errors: those of reading; with DISMANTLE_CORE_ONLY, Unreadable for everything but
/// `.dasm` files.
Result<AssemblyFile> read_assembly_input(const std::filesystem::path& file);

/// The input of a sample: `NAME.dasm` in the folder if it exists, else `NAME.step`. Errors: as read_assembly_input().
Result<AssemblyFile> read_sample_input(const std::filesystem::path& folder, const std::string& name);

}  // namespace dismantle
