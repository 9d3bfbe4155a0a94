// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"

#include <filesystem>

namespace dismantle {

/// Reads a 3MF package: one component for each occurrence of an object with a mesh among the build items, with the
/// object's name, the colour of the largest part of its surface, and the components of objects as tree. Instances share
/// their mesh. Objects may be in several model parts (production extension); supports are left out. The unit is the
/// file's, unless the options override it. Errors: Unreadable; Failed if cancelled; Usage for unknown units.
Result<Assembly> read_3mf(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace dismantle
