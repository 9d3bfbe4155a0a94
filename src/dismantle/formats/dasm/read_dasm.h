// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"

#include <filesystem>

namespace dismantle {

/// Reads an assembly from a `.dasm` file (assembly/assembly_file.h), in which it keeps the name and the hash of the
/// file that it was converted from; a motion in it is left out. Errors: Unreadable; Usage for unknown units.
Result<Assembly> read_dasm(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace dismantle
