// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/io/import_options.h"

#include <filesystem>

namespace dismantle {

/// Reads a STEP file (AP203, AP214, AP242) through OpenCASCADE's XDE: one component a leaf solid occurrence of the
/// product tree, with the product's name, colour, placement and tree; instances share their mesh. The file is parsed
/// and meshed in a child process, so that a file that crashes the CAD kernel is an Error and not a crash.
Result<Assembly> read_step(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace dismantle
