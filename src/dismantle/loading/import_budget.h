// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/formats/import/file_formats.h"
#include "dismantle/formats/import/import_options.h"
#include "dismantle/isolation/isolated_process.h"

#include <cstdint>

namespace dismantle {

/// What the process that reads a file of `bytes` may use: a multiple of what real files of its format take
/// (docs/design/0014-confined-readers.md), eight times as much where a deflection is asked for, or what
/// ImportOptions::limits say. `entry` is null for a folder of meshes.
IsolationLimits import_budget(const FormatEntry* entry, std::uint64_t bytes, const ImportOptions& options);

}  // namespace dismantle
